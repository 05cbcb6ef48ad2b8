#include "solve/costs.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "core/double_double.hpp"
#include "core/min_max.hpp"
#include "nda/check.hpp"
#include "solve/solutions.hpp"

namespace nda::pipeline {
namespace {

// Combines `start` with the costs of all arcs and the finite ones of all singletons, in an order of
// its own: in lanes that need not wait for each other.
template <typename Combine>
double combine_costs(const Problem& problem, double start, Combine&& combine) {
  std::array<double, 4> lanes;
  lanes.fill(start);
  const std::span<const double> costs = problem.costs();
  const std::size_t whole = costs.size() - costs.size() % lanes.size();
  for (std::size_t a = 0; a < whole; a += lanes.size()) {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane)
      lanes[lane] = combine(lanes[lane], costs[a + lane]);
  }
  double result = start;
  for (const double cost : costs.subspan(whole)) result = combine(result, cost);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (cost < kInfinity) result = combine(result, cost);
    }
  }
  for (const double lane : lanes) result = combine(result, lane);
  return result;
}

}  // namespace

double largest_cost(const Problem& problem) {
  return combine_costs(
      problem, 0, [](double most, double cost) { return core::max_of(most, std::abs(cost)); });
}

double smallest_cost(const Problem& problem) {
  const double found = combine_costs(problem, kInfinity, [](double least, double cost) {
    const double size = std::abs(cost);
    return size > 0 ? core::min_of(least, size) : least;
  });
  return found < kInfinity ? found : 0;
}

// The absolute costs of either sum up to at most its cost, and twice its negative costs.
double off_grid(const Problem& problem, double cost) {
  const double most_negative = combine_costs(problem, 0, core::min_of);
  const double negative = -static_cast<double>(problem.num_indices()) * most_negative;
  return 0x1p-52 * (2 * std::abs(cost) + 4 * negative);
}

std::string figure_text(double figure) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", figure);
  return text;
}

bool is_negligible(const Problem& problem, double difference, double cost) {
  return difference <= 1e-9 * std::abs(cost) || difference <= 1e-9 * smallest_cost(problem);
}

std::string rounding_reason(double error) {
  return "the rounding of the costs hides differences of " + figure_text(error);
}

std::string overflow_reason(double largest) {
  return "costs as large as " + figure_text(largest) + " overflow, scale them";
}

Solution overflow(const Problem& problem, double largest) {
  Solution solution = solution_of(problem);
  solution.status = Status::kPrecisionLost;
  core::DoubleDouble alone;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) alone.add(cost);
  }
  if (std::isfinite(alone.high())) {
    solution.cost = alone.high();
    solution.solutions.push_back({1, solution.cost, false, {}});
  }
  for (const Index size : problem.sizes()) solution.multipliers.emplace_back(size, 0.0);
  solution.lower_bound = certificate_bound(problem, solution.multipliers);
  solution.stats.certificate_bound = solution.lower_bound;
  solution.reason = overflow_reason(largest);
  return solution;
}

}  // namespace nda::pipeline
