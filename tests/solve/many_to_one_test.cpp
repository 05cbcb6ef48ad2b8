#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/many_to_one_problems.hpp"

namespace nda {
namespace {

using support::best_of_all;
using support::BoundedKind;
using support::random_bounded_problem;
using ::testing::HasSubstr;

std::optional<double> cost_of(const Problem& problem, const Solution& solution) {
  std::vector<std::size_t> arcs;
  for (const auto& tuple : solution.solutions.front().arcs) arcs.push_back(*problem.find(tuple));
  const auto cost = support::cost_of_choice(problem, arcs);
  if (!cost) return std::nullopt;
  return static_cast<double>(*cost);
}

// Everything that an optimal answer says is true.
void expect_optimum(const Problem& problem, const Solution& solution, double optimum) {
  const double tolerance = 1e-9 * std::max(1.0, std::abs(optimum));
  ASSERT_STREQ(to_string(solution.status), "optimal") << solution.reason;
  EXPECT_TRUE(solution.proven);
  EXPECT_NEAR(solution.cost, optimum, tolerance);
  EXPECT_LE(solution.lower_bound, solution.cost);
  EXPECT_NEAR(solution.lower_bound, optimum, tolerance);
  const auto recomputed = cost_of(problem, solution);
  ASSERT_TRUE(recomputed.has_value());
  EXPECT_NEAR(*recomputed, solution.cost, tolerance);
  EXPECT_LE(solution.stats.certificate_bound, optimum + tolerance);
  EXPECT_NEAR(solution.stats.certificate_bound,
              support::bound_of(problem, solution.multipliers),
              tolerance);
}

struct Count {
  int infeasible = 0;
  int feasible = 0;
};

void compare(const BoundedKind& kind, std::uint64_t seed, Count& count) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Problem problem = random_bounded_problem(seed, kind);
  const auto optimum = best_of_all(problem);
  const Solution solution = solve(problem);
  if (optimum) {
    ++count.feasible;
    expect_optimum(problem, solution, *optimum);
  } else {
    ++count.infeasible;
    EXPECT_STREQ(to_string(solution.status), "infeasible");
    EXPECT_EQ(solution.lower_bound, kInfinity);
    EXPECT_FALSE(solution.reason.empty());
  }
}

class ManyToOne : public ::testing::TestWithParam<int> {};

TEST_P(ManyToOne, AgreesWithAllSubsets) {
  Count count;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    BoundedKind kind;
    kind.dimensions = GetParam();
    kind.num_arcs = 7 + static_cast<int>(seed % 8);
    kind.tight = seed % 5 < 2;
    kind.integer = seed % 2 == 0;
    kind.forbidding = seed % 3 == 0;
    compare(kind, seed, count);
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(count.infeasible, 20);
  EXPECT_GT(count.feasible, 400);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ManyToOne, ::testing::Values(2, 3, 4, 5));

}  // namespace
}  // namespace nda
