#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::lap {

/// The pairs of each member of a side, one member after the other.
struct PairLines {
  std::vector<std::uint32_t> start;    ///< one more entry than members
  std::vector<std::uint32_t> partner;  ///< on the other side, ascending
  std::vector<double> cost;
};

/// The pairs that matter to assignments costing at most `reach` more than the best one: those whose
/// reduced cost under duals of the best is at most that.
///
/// A pool of the cheapest pairs is kept, so that the problem is looked through once for many cores.
class RankingCore {
 public:
  /// Nothing is in the pool.
  /// @param u, v  duals that prove the best assignment.
  /// @param problem  must outlive the core, which looks at it again; so must u and v.
  void start(const Assign2dProblem& problem, std::span<const double> u, std::span<const double> v);

  /// Makes the core of at least that reach: all of a pool of a few pairs a row, if that is enough.
  /// O(pairs of the problem).  @return its reach.
  double build_widely(double reach);
  /// Makes the core.  O(pairs of the pool); of the problem, if the pool is too small.
  void build(double reach);

  const PairLines& by_row() const { return by_row_; }
  const PairLines& by_column() const { return by_column_; }
  /// The least reduced cost of a pair that is allowed and not in the core; +inf if there is none.
  double next_reach() const { return next_reach_; }

 private:
  void fill_pool(double reach);
  double reach_of_few() const;
  void select(double reach);
  void transpose();

  Assign2dProblem problem_;
  std::span<const double> u_;
  std::span<const double> v_;
  PairLines pool_;
  std::vector<double> pool_reduced_;  // cost of each of its pairs
  double pool_reach_ = -1;
  double pool_next_ = kInfinity;  // least reduced cost of what is not in it
  PairLines by_row_;
  PairLines by_column_;
  double next_reach_ = kInfinity;
};

}  // namespace nda::lap
