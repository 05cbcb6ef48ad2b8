#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda {

/// A two-dimensional assignment problem with outside options, by rows (compressed sparse rows).
///
///     minimise  sum of cost over chosen pairs + row_outside over unassigned rows
///                                             + column_outside over unassigned columns,
///     every row and column in at most one pair.
///
/// Rows and columns count from 0.  An outside cost of +inf means "must be assigned"; a pair that is
/// absent, or of cost +inf, is forbidden.  Columns ascend within a row and do not repeat.
/// All other costs are finite; nothing is checked here (see validate()).
struct Assign2dProblem {
  std::span<const std::uint32_t> row_start;  ///< num_rows + 1 entries
  std::span<const std::uint32_t> column;     ///< of each pair
  std::span<const double> cost;              ///< of each pair
  std::span<const double> row_outside;       ///< num_rows entries
  std::span<const double> column_outside;    ///< num_columns entries

  std::uint32_t num_rows() const { return static_cast<std::uint32_t>(row_outside.size()); }
  std::uint32_t num_columns() const { return static_cast<std::uint32_t>(column_outside.size()); }
};

/// Not assigned.
inline constexpr std::int32_t kUnassigned = -1;

/// Answer of a two-dimensional solver.
///
/// When feasible the duals prove optimality: u[i] + v[j] <= cost(i, j) for every pair, u <= row_outside,
/// v <= column_outside, with equality for chosen pairs and for unassigned rows and columns (to rounding),
/// so that sum u + sum v = cost.  When infeasible, `hall_rows` or `hall_columns` names a set that cannot all
/// be assigned: together they have fewer partners than members.  cost is then +inf, the duals are meaningless.
struct Assign2dResult {
  bool feasible = true;
  double cost = 0;
  std::vector<std::int32_t> column_of_row;  ///< kUnassigned = outside option
  std::vector<std::int32_t> row_of_column;
  std::vector<double> u;                    ///< dual of each row
  std::vector<double> v;                    ///< dual of each column
  std::vector<std::uint32_t> hall_rows;
  std::vector<std::uint32_t> hall_columns;
};

}  // namespace nda
