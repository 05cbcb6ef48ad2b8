#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace nda::lap {

/// A 4-ary heap of members 0..n-1 with decrease of a key.
///
/// Keys lie beside the members, so that the four children compared in a step down share a cache
/// line. What a search leaves behind is removed in time proportional to what it left, not to n.
class QuadHeap {
 public:
  /// For members below n; empties the heap.
  void resize(std::size_t n) {
    clear();
    if (place_.size() < n) place_.resize(n, kAbsent);
    items_.reserve(n);
  }

  bool empty() const { return items_.empty(); }
  double top_key() const { return items_.front().key; }
  bool contains(std::uint32_t member) const { return place_[member] != kAbsent; }

  /// Inserts `member`, or moves it up if its new key is smaller than its old one.
  void push_or_decrease(std::uint32_t member, double key) {
    std::uint32_t at = place_[member];
    if (at == kAbsent) {
      at = static_cast<std::uint32_t>(items_.size());
      items_.push_back({key, member});
    }
    sift_up(at, {key, member});
  }

  std::uint32_t pop() {
    const std::uint32_t top = items_.front().member;
    const Item last = items_.back();
    place_[top] = kAbsent;
    items_.pop_back();
    if (!items_.empty()) sift_down(last);
    return top;
  }

  void clear() {
    for (const Item& item : items_) place_[item.member] = kAbsent;
    items_.clear();
  }

 private:
  struct Item {
    double key;
    std::uint32_t member;
  };
  static constexpr std::uint32_t kAbsent = std::numeric_limits<std::uint32_t>::max();

  void put(std::uint32_t at, const Item& item) {
    items_[at] = item;
    place_[item.member] = at;
  }

  void sift_up(std::uint32_t at, const Item& item) {
    while (at > 0) {
      const std::uint32_t parent = (at - 1) / 4;
      if (!(item.key < items_[parent].key)) break;
      put(at, items_[parent]);
      at = parent;
    }
    put(at, item);
  }

  // Lets `item` fall from the root.
  void sift_down(const Item& item) {
    const std::uint32_t size = static_cast<std::uint32_t>(items_.size());
    std::uint32_t at = 0;
    for (std::uint32_t child = 1; child < size; child = 4 * at + 1) {
      std::uint32_t least = child;
      const std::uint32_t end = child + 4 < size ? child + 4 : size;
      for (std::uint32_t c = child + 1; c < end; ++c) {
        if (items_[c].key < items_[least].key) least = c;
      }
      if (!(items_[least].key < item.key)) break;
      put(at, items_[least]);
      at = least;
    }
    put(at, item);
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> place_;  // of each member in items_
};

}  // namespace nda::lap
