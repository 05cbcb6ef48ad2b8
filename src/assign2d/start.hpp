#pragma once

#include <algorithm>
#include <cmath>

#include "assign2d/side.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// The largest finite magnitude, 0 if there is none.
double largest_magnitude(std::span<const double> values);

/// Prepares `result` for a solve: sizes, nothing assigned, everything feasible so far.
void reset(std::size_t num_rows, std::size_t num_columns, Assign2dResult& result);

/// True if `result` can be the start of a warm solve: feasible, of the same shape, and with prices
/// that are finite and not so far beyond the costs that their rounding would matter.
bool can_start_warm(std::span<const double> cost,
                    std::span<const double> row_outside,
                    std::span<const double> column_outside,
                    const Assign2dResult& result);

/// Where in the range of sensible prices a cold solve starts: as satisfies the columns, or in the
/// middle, so that rows and columns both are in want.
enum class ColdStart { kColumnsSatisfied, kMiddle };

/// Start prices for a cold solve: v <= column_outside, finite.
///
/// The lowest sensible price is min over i of c_ij - p_i (column reduction), where p_i is
/// row_outside if that is in proportion to the costs (rows are then satisfied) and a row minimum
/// otherwise; the highest is column_outside (columns are then satisfied).  A column that must be
/// assigned, or whose outside option is out of proportion, starts from the lowest, any other from
/// the highest or from the middle of both.
/// @param cost  those of `view`, which is RowView or DenseView of the rows.
/// @param result  sized; its u is scratch.
template <class View>
void cold_prices(const View& view,
                 std::span<const double> cost,
                 std::span<const double> row_outside,
                 std::span<const double> column_outside,
                 ColdStart where,
                 Assign2dResult& result) {
  const std::span<double> v = result.v;
  std::copy(column_outside.begin(), column_outside.end(), v.begin());
  const double most = v.empty() ? 0 : *std::max_element(v.begin(), v.end());
  const double least = v.empty() ? 0 : *std::min_element(v.begin(), v.end());
  const double in_proportion = most > 0 && least < kInfinity ? largest_magnitude(cost) : 0;
  if (most <= in_proportion && where == ColdStart::kColumnsSatisfied) return;

  const std::span<double> potential = result.u;
  for (double& price : v) price = std::min(price, in_proportion);
  for (std::uint32_t i = 0; i < row_outside.size(); ++i) {
    potential[i] = row_outside[i] <= in_proportion
                       ? row_outside[i]
                       : std::min(row_outside[i], view.least_offer(i, v));
  }
  std::copy(column_outside.begin(), column_outside.end(), v.begin());
  for (std::uint32_t i = 0; i < row_outside.size(); ++i) {
    if (potential[i] < kInfinity) view.lower_bounds(i, potential[i], v);
  }
  const double share = where == ColdStart::kMiddle ? 0.5 : 0;
  for (std::size_t j = 0; j < v.size(); ++j) {
    if (column_outside[j] <= in_proportion) {
      v[j] = column_outside[j] - share * (column_outside[j] - v[j]);
    }
    if (v[j] == kInfinity) v[j] = 0;
  }
}

/// Prepares `result` and sets start prices: warm if asked for and possible (prices clipped to
/// column_outside, column_of_row keeping the former mates as a hint), otherwise cold.  @return
/// whether warm.
template <class View>
bool start(const View& view,
           std::span<const double> cost,
           std::span<const double> row_outside,
           std::span<const double> column_outside,
           ColdStart where,
           Assign2dResult& result,
           bool warm) {
  warm = warm && can_start_warm(cost, row_outside, column_outside, result);
  reset(row_outside.size(), column_outside.size(), result);
  if (warm) {
    const auto num_columns = static_cast<std::int32_t>(column_outside.size());
    for (std::int32_t& mate : result.column_of_row) {
      if (mate < 0 || mate >= num_columns) mate = kUnassigned;
    }
    for (std::size_t j = 0; j < column_outside.size(); ++j) {
      result.v[j] = std::min(result.v[j], column_outside[j]);
    }
  } else {
    std::fill(result.column_of_row.begin(), result.column_of_row.end(), kUnassigned);
    cold_prices(view, cost, row_outside, column_outside, where, result);
  }
  return warm;
}

/// Completes `result` from assignment and v: u and cost from the costs of the chosen pairs, or the
/// look of an infeasible result.  `pair_cost(i)` is the cost of the pair of the assigned row i.
template <class PairCost>
void finish(std::span<const double> row_outside,
            std::span<const double> column_outside,
            bool feasible,
            Assign2dResult& result,
            const PairCost& pair_cost) {
  result.feasible = feasible;
  result.cost = feasible ? 0 : kInfinity;
  if (!feasible) return;
  for (std::uint32_t i = 0; i < row_outside.size(); ++i) {
    const std::int32_t j = result.column_of_row[i];
    const double cost = j == kUnassigned ? row_outside[i] : pair_cost(i);
    result.u[i] = j == kUnassigned ? cost : cost - result.v[j];
    result.cost += cost;
  }
  for (std::uint32_t j = 0; j < column_outside.size(); ++j) {
    if (result.row_of_column[j] == kUnassigned) result.cost += column_outside[j];
  }
}

}  // namespace nda::lap
