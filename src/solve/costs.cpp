#include "solve/costs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/double_double.hpp"
#include "nda/check.hpp"
#include "solve/solutions.hpp"

namespace nda::pipeline {
namespace {

// Calls note(|c|) for all arcs and finite singletons.
template <typename Note>
void for_each_cost(const Problem& problem, Note&& note) {
  for (const double cost : problem.costs()) note(std::abs(cost));
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (cost < kInfinity) note(std::abs(cost));
    }
  }
}

}  // namespace

double largest_cost(const Problem& problem) {
  double largest = 0;
  for_each_cost(problem, [&](double size) { largest = std::max(largest, size); });
  return largest;
}

double smallest_cost(const Problem& problem) {
  double least = kInfinity;
  for_each_cost(problem, [&](double size) {
    if (size > 0) least = std::min(least, size);
  });
  return least < kInfinity ? least : 0;
}

// The absolute costs of either sum up to at most its cost, and twice its negative costs.
double off_grid(const Problem& problem, double cost) {
  double most_negative = 0;
  const auto note = [&](double c) { most_negative = std::min(most_negative, c); };
  std::for_each(problem.costs().begin(), problem.costs().end(), note);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto singletons = problem.singleton_costs(k);
    std::for_each(singletons.begin(), singletons.end(), note);
  }
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
