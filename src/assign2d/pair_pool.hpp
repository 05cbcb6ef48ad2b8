#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::lap {

/// The pairs of least reduced cost of a problem whose best assignment is known: those that matter
/// to assignments which cost little more.
class PairPool {
 public:
  /// Empty so far.
  /// @param problem  must outlive the pool, which looks at it again.
  /// @param best  an optimal assignment with the duals that prove it; copied.
  void start(const Assign2dProblem& problem, const Assign2dResult& best);

  /// Makes sure that all pairs of reduced cost up to `reach` are there; others may be, too.
  /// O(pairs of the problem) where that is news; pairs are then numbered anew.
  void fill(double reach);
  /// A reach that takes a few pairs a row; +inf where the problem has no more.
  double reach_of_few() const;
  /// The least reduced cost above `reach` of an allowed pair; +inf if there is none.  The pool must
  /// have been filled up to it.
  double next_reach(double reach) const;

  /// First pair of row i; row num_rows is the end.
  std::uint32_t begin(std::uint32_t i) const { return start_[i]; }
  std::uint32_t column(std::uint32_t pair) const { return column_[pair]; }
  double cost(std::uint32_t pair) const { return cost_[pair]; }
  double reduced_cost(std::uint32_t pair) const { return reduced_[pair]; }  ///< not negative
  const Assign2dResult& best() const { return best_; }

 private:
  Assign2dProblem problem_;
  Assign2dResult best_;
  double reach_ = -1;
  double next_ = kInfinity;  // least reduced cost of what is not in it
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> column_;
  std::vector<double> cost_;
  std::vector<double> reduced_;
};

}  // namespace nda::lap
