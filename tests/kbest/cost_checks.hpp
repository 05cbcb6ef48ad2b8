#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "nda/check.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"
#include "support/brute_force.hpp"

namespace nda {

/// The costs of all solutions, ascending; nothing where there are more than 5000.
inline std::optional<std::vector<double>> all_costs(const Problem& problem) {
  try {
    return support::all_costs(problem, 5000);
  } catch (const std::length_error&) {
    return std::nullopt;
  }
}

/// What sums of costs of a problem may be apart by rounding.
inline double cost_tolerance(const Problem& problem) {
  double size = 0;
  for (const double cost : problem.costs()) size += std::abs(cost);
  for (int d = 0; d < problem.num_dimensions(); ++d) {
    for (const double cost : problem.singleton_costs(d))
      size += cost < kInfinity ? std::abs(cost) : 0;
  }
  return 1e-9 * size;
}

/// The k first of all, or all, no more than rounding apart.
inline void expect_costs(const Problem& problem,
                         const std::vector<double>& all,
                         std::size_t k,
                         const std::vector<double>& costs) {
  ASSERT_EQ(costs.size(), std::min(k, all.size()));
  const double tolerance = cost_tolerance(problem);
  for (std::size_t r = 0; r < costs.size(); ++r)
    EXPECT_NEAR(costs[r], all[r], tolerance) << "rank " << r + 1;
}

/// Of every rank.
inline std::vector<double> costs_of(const std::vector<RankedSolution>& solutions) {
  std::vector<double> costs;
  for (const RankedSolution& ranked : solutions) costs.push_back(ranked.cost);
  return costs;
}

/// All are solutions, numbered, and different.
inline void expect_sound(const Problem& problem, const Solution& solution) {
  EXPECT_THAT(check(problem, solution).faults, ::testing::IsEmpty());
  std::set<std::vector<std::vector<Index>>> different;
  for (std::size_t r = 0; r < solution.solutions.size(); ++r) {
    EXPECT_EQ(solution.solutions[r].rank, static_cast<int>(r) + 1);
    EXPECT_TRUE(different.insert(solution.solutions[r].arcs).second) << "rank " << r + 1;
  }
}

}  // namespace nda
