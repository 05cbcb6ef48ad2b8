#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "core/clock.hpp"

namespace nda::kbest {

/// A set of arcs, as a number that `Combinations` understands.
using Combination = std::uint32_t;
inline constexpr Combination kNothing = 0;

/// Sets of arcs that share their parts: joining two takes constant time and memory, whatever they
/// hold.  So a list of thousands of solutions that differ here and there stays small.  Throws
/// std::bad_alloc beyond 2^32 of them (32 GiB).
class Combinations {
 public:
  Combination single(std::uint32_t arc) { return add({arc, kLeaf}); }
  /// The two must be disjoint.
  Combination join(Combination a, Combination b) {
    if (a == kNothing) return b;
    return b == kNothing ? a : add({a, b});
  }
  /// The arcs, in no particular order.  Cost: their number.
  std::vector<std::uint32_t> arcs(Combination combination) const;

  /// How many there are, kNothing among them.
  std::size_t size() const { return pairs_.size(); }
  /// Forgets all but the first so many; nobody may hold one of the others any more.
  void keep_first(std::size_t count) { pairs_.resize(count); }

 private:
  struct Pair {
    std::uint32_t first;  // of a leaf: the arc
    std::uint32_t second;
  };
  static constexpr std::uint32_t kLeaf = ~std::uint32_t{0};

  Combination add(Pair pair) {
    if (pairs_.size() >= kLeaf) throw std::bad_alloc();
    pairs_.push_back(pair);
    return static_cast<Combination>(pairs_.size() - 1);
  }

  std::vector<Pair> pairs_ = {{0, 0}};  // the first is kNothing
};

/// A packing and the terms of its cost that the search for it is about.
struct Ranked {
  double slack = 0;
  Combination arcs = kNothing;
};

/// Packings of least slack, ascending.
using RankedList = std::vector<Ranked>;

/// Merges `more` into `list`, both ascending, and keeps the k least.
void merge_ranked(RankedList& list, const RankedList& more, std::size_t k);

/// One of each list, in all ways: the k least sums below `budget`, ascending; some thousands of
/// them at least, and those before the deadline.  Lazy: O(k log k).
/// @param left_out  lowered to the least sum beyond the budget that was met; may be null.  If there
///                  are fewer than k below it, that is the least of all beyond it.
/// Source: the frontier of Lawler (1972) for sums of two lists.
RankedList combine_ranked(const RankedList& a,
                          const RankedList& b,
                          std::size_t k,
                          double budget,
                          Combinations& combinations,
                          double* left_out = nullptr,
                          const core::Deadline& deadline = {});

}  // namespace nda::kbest
