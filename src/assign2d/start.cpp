#include "assign2d/start.hpp"

namespace nda::lap {
namespace {

// Prices this much beyond the costs would lose more than five of sixteen digits.
constexpr double kStalePriceRatio = 1e5;

// Costs looked at to find one in proportion to the prices.
constexpr std::size_t kSampledCosts = 10000;

bool any_reaches(std::span<const double> values, double least) {
  for (const double x : values) {
    if (std::abs(x) >= least && x < kInfinity) return true;
  }
  return false;
}

}  // namespace

double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (const double x : values) {
    if (std::abs(x) > largest && x < kInfinity) largest = std::abs(x);
  }
  return largest;
}

void reset(std::size_t num_rows, std::size_t num_columns, Assign2dResult& result) {
  result.feasible = true;
  result.cost = 0;
  result.hall_rows.clear();
  result.hall_columns.clear();
  result.column_of_row.resize(num_rows);
  result.row_of_column.assign(num_columns, kUnassigned);
  result.u.assign(num_rows, 0);
  result.v.resize(num_columns);
}

bool can_start_warm(std::span<const double> cost,
                    std::span<const double> row_outside,
                    std::span<const double> column_outside,
                    const Assign2dResult& result) {
  if (!result.feasible || result.v.size() != column_outside.size() ||
      result.column_of_row.size() != row_outside.size()) {
    return false;
  }
  double largest = 0;
  for (const double v : result.v) {
    if (!std::isfinite(v)) return false;
    largest = std::max(largest, std::abs(v));
  }
  const double least = largest / kStalePriceRatio;
  return any_reaches(cost.first(std::min(cost.size(), kSampledCosts)), least) ||
         any_reaches(row_outside, least) || any_reaches(column_outside, least);
}

}  // namespace nda::lap
