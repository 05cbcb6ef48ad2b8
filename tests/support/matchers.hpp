#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nda/problem.hpp"

namespace nda::support {

using Tuples = std::vector<std::vector<Index>>;

/// What is wrong with this choice of arcs, one sentence; empty when feasible: every tuple is an arc
/// of the problem with two or more real indices and there once, every real index is used as often
/// as its bounds want, singletons included where they are not forbidden.
std::string infeasibility(const Problem& problem, const Tuples& arcs);

/// Cost of the arcs plus the singletons that the bounds then ask for or that pay, added in long
/// double.
/// +inf when a tuple is no arc of the problem.
double cost_of(const Problem& problem, const Tuples& arcs);

MATCHER_P(IsFeasibleForPointee, problem, "is feasible") {
  const std::string fault = infeasibility(*problem, arg);
  *result_listener << fault;
  return fault.empty();
}

/// Matches the arcs of a feasible solution:  EXPECT_THAT(solution.arcs, IsFeasibleFor(problem)).
inline auto IsFeasibleFor(const Problem& problem) {
  return IsFeasibleForPointee(&problem);
}

MATCHER_P2(HasCostFor, problem, tolerance, "states the cost of its arcs") {
  const double cost = cost_of(*problem, arg.arcs);
  *result_listener << "stated " << ::testing::PrintToString(arg.cost) << ", recomputed "
                   << ::testing::PrintToString(cost);
  return arg.cost == cost || std::abs(arg.cost - cost) <= tolerance;
}

/// Matches anything with `arcs` and `cost` whose cost is that of its arcs, to an absolute
/// tolerance.
inline auto HasCost(const Problem& problem, double tolerance) {
  return HasCostFor(&problem, tolerance);
}

/// Matches anything with `lower_bound` and `cost` such that lower_bound <= optimum <= cost, to
/// rounding (1e-9 of the optimum's size).
MATCHER_P(BracketsOptimum, optimum, "brackets " + ::testing::PrintToString(optimum)) {
  const double slack = 1e-9 * std::max(1.0, std::abs(static_cast<double>(optimum)));
  *result_listener << "from " << ::testing::PrintToString(arg.lower_bound) << " to "
                   << ::testing::PrintToString(arg.cost);
  return arg.lower_bound <= optimum + slack && arg.cost >= optimum - slack;
}

}  // namespace nda::support
