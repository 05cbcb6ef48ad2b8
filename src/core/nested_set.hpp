#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace nda::core {

/// Numbers below n, of which a search keeps fewer and fewer on its way down and has them back on
/// its way up: a permuted list, of which a range counts.  Within the range the order is what it
/// was, so a walk over all of it stays a walk through memory.
class NestedSet {
 public:
  struct Range {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  /// All numbers, ascending.
  explicit NestedSet(std::size_t size)
      : members_(size), place_(size), range_{0, static_cast<std::uint32_t>(size)} {
    std::iota(members_.begin(), members_.end(), 0u);
    std::iota(place_.begin(), place_.end(), 0u);
  }

  std::span<const std::uint32_t> members() const {
    return std::span(members_).subspan(range_.begin, range_.end - range_.begin);
  }
  bool contains(std::uint32_t number) const {
    return place_[number] >= range_.begin && place_[number] < range_.end;
  }

  Range range() const { return range_; }
  /// To one that range() or divide() gave, before it was left for one around it.
  void set_range(Range range) { range_ = range; }

  /// Cost: O(members).
  template <typename Keep>
  void keep_if(Keep&& keep) {
    const std::span<std::uint32_t> all = here();
    const auto end = std::stable_partition(all.begin(), all.end(), keep);
    note_places();
    range_.end = range_.begin + static_cast<std::uint32_t>(end - all.begin());
  }

  /// The range of every key; the numbers with one key stand together from now on.
  /// @param key  of a number: below num_keys.
  /// Cost: O(members log members + keys).
  template <typename Key>
  std::vector<Range> divide(std::size_t num_keys, Key&& key) {
    const std::span<std::uint32_t> all = here();
    std::stable_sort(
        all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    note_places();
    std::vector<Range> ranges(num_keys);
    std::uint32_t place = range_.begin;
    for (std::size_t k = 0; k < num_keys; ++k) {
      ranges[k].begin = place;
      while (place < range_.end && key(members_[place]) == k) ++place;
      ranges[k].end = place;
    }
    return ranges;
  }

 private:
  std::span<std::uint32_t> here() {
    return std::span(members_).subspan(range_.begin, range_.end - range_.begin);
  }
  void note_places() {
    for (std::uint32_t i = range_.begin; i < range_.end; ++i) place_[members_[i]] = i;
  }

  std::vector<std::uint32_t> members_;
  std::vector<std::uint32_t> place_;  // by number: in members_
  Range range_;
};

}  // namespace nda::core
