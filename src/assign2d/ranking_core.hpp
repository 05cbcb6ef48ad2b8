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
/// reduced cost under the duals of the best is at most that.
class RankingCore {
 public:
  /// @param u, v  duals that prove the best assignment.  O(pairs).
  void build(const Assign2dProblem& problem,
             std::span<const double> u,
             std::span<const double> v,
             double reach);

  const PairLines& by_row() const { return by_row_; }
  const PairLines& by_column() const { return by_column_; }
  /// The least reduced cost of a pair that is allowed and not in the core; +inf if there is none.
  double next_reach() const { return next_reach_; }

 private:
  void select(const Assign2dProblem& problem,
              std::span<const double> u,
              std::span<const double> v,
              double reach);
  void transpose(std::uint32_t num_columns);

  PairLines by_row_;
  PairLines by_column_;
  double next_reach_ = kInfinity;
};

}  // namespace nda::lap
