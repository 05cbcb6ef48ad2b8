#include "assign2d/start.hpp"

#include <algorithm>
#include <cmath>

namespace nda::lap {
namespace {

// Prices this much beyond the costs would lose more than five of sixteen digits.
constexpr double kStalePriceRatio = 1e5;

double finite_magnitude(double x) {
  return std::isfinite(x) ? std::abs(x) : 0;
}

double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (const double x : values) {
    const double magnitude = finite_magnitude(x);
    if (magnitude > largest) largest = magnitude;
  }
  return largest;
}

// A cheap stand-in for the largest cost: outside costs and the first pair of every row.
double sampled_scale(const Assign2dProblem& problem) {
  double scale =
      std::max(largest_magnitude(problem.row_outside), largest_magnitude(problem.column_outside));
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const std::uint32_t k = problem.row_start[i];
    if (k < problem.row_start[i + 1]) scale = std::max(scale, finite_magnitude(problem.cost[k]));
  }
  return scale;
}

// The least c_ij - v_j over the pairs of row i; +inf if there is none.
double row_minimum(const Assign2dProblem& problem, std::span<const double> v, std::uint32_t i) {
  double least = kInfinity;
  for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
    const double offer = problem.cost[k] - v[problem.column[k]];
    if (offer < least) least = offer;
  }
  return least;
}

// Lowers the prices of column reduction to c_ij - potential over the pairs of row i.
void reduce_columns(const Assign2dProblem& problem,
                    std::uint32_t i,
                    double potential,
                    double in_proportion,
                    std::span<double> v) {
  for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
    const std::uint32_t j = problem.column[k];
    if (problem.column_outside[j] <= in_proportion) continue;
    v[j] = std::min(v[j], problem.cost[k] - potential);
  }
}

bool can_start_warm(const Assign2dProblem& problem, const Assign2dResult& result) {
  if (!result.feasible || result.v.size() != problem.num_columns() ||
      result.column_of_row.size() != problem.num_rows()) {
    return false;
  }
  double largest = 0;
  for (const double v : result.v) {
    if (!std::isfinite(v)) return false;
    largest = std::max(largest, std::abs(v));
  }
  return largest <= kStalePriceRatio * sampled_scale(problem);
}

}  // namespace

bool start(const Assign2dProblem& problem, Assign2dResult& result, bool warm) {
  warm = warm && can_start_warm(problem, result);
  result.hall_rows.clear();
  result.hall_columns.clear();
  result.row_of_column.assign(problem.num_columns(), kUnassigned);
  result.u.assign(problem.num_rows(), 0);
  if (warm) {
    for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
      result.v[j] = std::min(result.v[j], problem.column_outside[j]);
    }
    return true;
  }
  result.column_of_row.assign(problem.num_rows(), kUnassigned);
  result.v.resize(problem.num_columns());
  cold_prices(problem, result);
  return false;
}

void cold_prices(const Assign2dProblem& problem, Assign2dResult& result) {
  const std::span<double> v = result.v;
  const std::span<const double> outside = problem.column_outside;
  std::copy(outside.begin(), outside.end(), v.begin());
  if (std::all_of(v.begin(), v.end(), [](double s) { return s <= 0; })) return;
  const double in_proportion = largest_magnitude(problem.cost);
  if (std::all_of(v.begin(), v.end(), [=](double s) { return s <= in_proportion; })) return;

  for (double& price : v) price = std::min(price, in_proportion);
  const std::span<double> potential = result.u;
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const double row_outside = problem.row_outside[i];
    potential[i] = row_outside <= in_proportion ? row_outside : row_minimum(problem, v, i);
  }
  for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
    if (outside[j] > in_proportion) v[j] = outside[j];
  }
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    if (potential[i] < kInfinity) reduce_columns(problem, i, potential[i], in_proportion, v);
  }
  for (double& price : v) {
    if (price == kInfinity) price = 0;
  }
}

}  // namespace nda::lap
