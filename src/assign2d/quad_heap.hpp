#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nda::lap {

/// A 4-ary heap of members 0..n-1 whose keys live with the caller, with decrease of a key.
///
/// Four children share a cache line and halve the height; what a search leaves behind is removed in
/// time proportional to what it left, not to n.
class QuadHeap {
 public:
  /// For members below n; empties the heap.
  void resize(std::size_t n) {
    clear();
    if (place_.size() < n) place_.resize(n, kAbsent);
    if (members_.capacity() < n) members_.reserve(n);
  }

  bool empty() const { return members_.empty(); }
  std::uint32_t top() const { return members_.front(); }

  /// Inserts `member`, or moves it up after its key became smaller.
  void push_or_decrease(std::uint32_t member, std::span<const double> key) {
    std::uint32_t at = place_[member];
    if (at == kAbsent) {
      at = static_cast<std::uint32_t>(members_.size());
      members_.push_back(member);
    }
    sift_up(at, member, key);
  }

  std::uint32_t pop(std::span<const double> key) {
    const std::uint32_t top = members_.front();
    const std::uint32_t last = members_.back();
    place_[top] = kAbsent;
    members_.pop_back();
    if (!members_.empty()) sift_down(last, key);
    return top;
  }

  void clear() {
    for (const std::uint32_t member : members_) place_[member] = kAbsent;
    members_.clear();
  }

 private:
  static constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

  void put(std::uint32_t at, std::uint32_t member) {
    members_[at] = member;
    place_[member] = at;
  }

  void sift_up(std::uint32_t at, std::uint32_t member, std::span<const double> key) {
    while (at > 0) {
      const std::uint32_t parent = (at - 1) / 4;
      if (!(key[member] < key[members_[parent]])) break;
      put(at, members_[parent]);
      at = parent;
    }
    put(at, member);
  }

  // Lets `member` fall from the root.
  void sift_down(std::uint32_t member, std::span<const double> key) {
    const std::uint32_t size = static_cast<std::uint32_t>(members_.size());
    std::uint32_t at = 0;
    for (std::uint32_t child = 1; child < size; child = 4 * at + 1) {
      std::uint32_t least = child;
      for (std::uint32_t c = child + 1; c < child + 4 && c < size; ++c) {
        if (key[members_[c]] < key[members_[least]]) least = c;
      }
      if (!(key[members_[least]] < key[member])) break;
      put(at, members_[least]);
      at = least;
    }
    put(at, member);
  }

  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> place_;  // of each member in members_
};

}  // namespace nda::lap
