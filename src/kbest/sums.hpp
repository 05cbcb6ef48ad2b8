#pragma once

#include <cstddef>
#include <optional>
#include <queue>
#include <vector>

#include "kbest/combinations.hpp"

namespace nda::kbest {

/// One packing of each list, in all ways, least sum first, one after the other.  Cost: O(lists log
/// lists), then O(log n) for the n-th sum, however many lists there are.
class Sums {
 public:
  /// @param lists  ascending, none empty; they and `combinations` must outlive it.
  Sums(std::vector<const RankedList*> lists, Combinations& combinations);

  /// The next one; nothing if there is none.
  std::optional<Ranked> next();

 private:
  // Of the lists before `list` these `packings`, of it the one at `position`, of all others the
  // first.
  struct Choice {
    double slack;
    std::size_t list;
    std::size_t position;
    Ranked packings;
    // Of equal sums the order is that of lists, so it does not depend on the heap.
    bool operator>(const Choice& other) const;
  };

  const Ranked& packing(std::size_t list, std::size_t position) const {
    return (*lists_[list])[position];
  }
  void enter(std::size_t list, std::size_t position, const Ranked& packings);
  void enter_successors(const Choice& choice);
  Ranked join(const Ranked& a, const Ranked& b);

  std::vector<const RankedList*> lists_;  // those of two or more, by what the second has more
  Combinations& combinations_;
  std::vector<Ranked> rest_;  // [list]: the first of it and of all later ones, and of the others
  bool has_begun_ = false;
  std::priority_queue<Choice, std::vector<Choice>, std::greater<>> open_;
};

}  // namespace nda::kbest
