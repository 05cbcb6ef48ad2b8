#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/component.hpp"
#include "kbest/combinations.hpp"

namespace nda::kbest {

/// The k cheapest ways to choose one packing of each of several lists.
class PackingSums {
 public:
  explicit PackingSums(std::size_t k) : k_(k) {}

  /// Adds a list, ascending by cost.  After an empty one there is no way.  Cost: O(k log k).
  void add(const std::vector<core::Packing>& list);

  /// Number of ways, at most k.
  std::size_t size() const { return sums_.size(); }
  double cost(std::size_t n) const { return sums_[n].slack; }

  /// One packing of each list: (number of the list, number within it), both from 0.
  using Choice = std::vector<std::pair<std::size_t, std::size_t>>;
  /// The n-th cheapest way.
  Choice choice(std::size_t n) const;

 private:
  std::size_t k_;
  std::size_t num_lists_ = 0;
  Combinations combinations_;
  Choice members_;  // what a leaf stands for
  RankedList sums_ = {{0, kNothing}};
};

}  // namespace nda::kbest
