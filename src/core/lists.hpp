#pragma once

#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace nda::core {

/// Lists of items side by side in memory, one for every key: the arcs of every index, for example.
template <typename Item>
class Lists {
 public:
  Lists() = default;

  /// for_each(visit) calls visit(key, item) for every pair, both times in the same order, which
  /// becomes that of the lists; keys are below num_keys.  Cost: two such passes.
  template <typename ForEach>
  Lists(std::size_t num_keys, ForEach&& for_each) : start_(num_keys + 1, 0) {
    for_each([&](std::size_t key, const Item&) { ++start_[key + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    items_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for_each([&](std::size_t key, const Item& item) { items_[next[key]++] = item; });
  }

  std::span<const Item> operator[](std::size_t key) const {
    return std::span(items_).subspan(start_[key], start_[key + 1] - start_[key]);
  }
  /// The same, to change the order of a list.
  std::span<Item> list(std::size_t key) {
    return std::span(items_).subspan(start_[key], start_[key + 1] - start_[key]);
  }

 private:
  std::vector<std::size_t> start_ = {0};
  std::vector<Item> items_;
};

}  // namespace nda::core
