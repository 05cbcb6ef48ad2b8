#include "support/brute_force.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nda/baselines.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using support::HasCost;
using support::IsFeasibleFor;

TEST(SolveBruteForce, FindsTheOptimumOfTheTinyProblems) {
  for (const support::TinyProblem& tiny : support::all_tiny_problems()) {
    SCOPED_TRACE(tiny.name);
    const BaselineResult result = solve_brute_force(tiny.problem);
    ASSERT_EQ(result.feasible, tiny.optimum.has_value());
    EXPECT_DOUBLE_EQ(result.cost, tiny.optimum.value_or(kInfinity));
  }
}

TEST(SolveBruteForce, AgreesWithTheJudgeOfTheTests) {
  int num_feasible = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    SCOPED_TRACE(instance.description);
    const auto expected = support::brute_force(instance.problem);
    const BaselineResult result = solve_brute_force(instance.problem);
    ASSERT_EQ(result.feasible, expected.has_value());
    if (!expected) continue;
    ++num_feasible;
    EXPECT_DOUBLE_EQ(result.cost, expected->cost);
    EXPECT_THAT(result.arcs, IsFeasibleFor(instance.problem));
    EXPECT_THAT(result, HasCost(instance.problem, 0));
  }
  EXPECT_GT(num_feasible, 2500);
}

TEST(SolveBruteForce, RefusesWhatIsTooLarge) {
  ProblemBuilder many_indices({60, 5});
  EXPECT_THROW(solve_brute_force(std::move(many_indices).build()), InputError);
  ProblemBuilder most_indices({32, 32});
  EXPECT_EQ(solve_brute_force(std::move(most_indices).build()).cost, 0);
  ProblemBuilder many_arcs({13, 5});
  for (Index i = 1; i <= 13; ++i) {
    for (Index j = 1; j <= 5; ++j) many_arcs.add_arc({i, j}, 1);
  }
  EXPECT_THROW(solve_brute_force(std::move(many_arcs).build()), InputError);
}

}  // namespace
}  // namespace nda
