#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda::core {

/// Index i_k of every arc of a component: a vector of its own, or borrowed from whoever outlives
/// it.
class Column {
 public:
  using value_type = Index;
  using const_reference = const Index&;
  using const_iterator = const Index*;
  using iterator = const_iterator;

  Column() = default;
  Column(const Column& other) : own_(other.own_), data_(other.data_), size_(other.size_) {
    if (!own_.empty()) data_ = own_.data();
  }
  Column(Column&&) noexcept = default;
  Column& operator=(Column other) noexcept {
    own_.swap(other.own_);
    data_ = other.data_;
    size_ = other.size_;
    return *this;
  }
  ~Column() = default;

  static Column borrow(std::span<const Index> indices) {
    Column column;
    column.data_ = indices.data();
    column.size_ = indices.size();
    return column;
  }

  /// Makes this a column of its own of so many arcs, to be written by the caller.
  std::span<Index> allocate(std::size_t size) {
    own_.assign(size, 0);
    data_ = own_.data();
    size_ = size;
    return own_;
  }

  /// Not for borrowed columns.
  void reserve(std::size_t size) {
    own_.reserve(size);
    data_ = own_.data();
  }
  void push_back(Index index) {
    own_.push_back(index);
    data_ = own_.data();
    size_ = own_.size();
  }

  const Index& operator[](std::size_t a) const { return data_[a]; }
  const Index* data() const { return data_; }
  std::size_t size() const { return size_; }
  const Index* begin() const { return data_; }
  const Index* end() const { return data_ + size_; }

  friend bool operator==(const Column& a, const Column& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::vector<Index> own_;
  const Index* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace nda::core
