#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nda/baselines.hpp"
#include "support/brute_force.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using support::HasCost;
using support::IsFeasibleFor;

TEST(SolveGreedy, StartsWithTheCheapestArcAndRegretsIt) {
  EXPECT_EQ(solve_greedy(support::crossing_tracks().problem).cost, -7);
}

TEST(SolveGreedy, CountsInShiftedCosts) {
  // (1,1) at 1 replaces singletons of 3 + 3, (1,2) at 0 replaces 3 + 0.
  const Problem problem = support::make_problem(
      {1, 2}, {{{1, 1}, 1}, {{1, 2}, 0}, {{1, 0}, 3}, {{0, 1}, 3}, {{0, 2}, 0}});
  const BaselineResult result = solve_greedy(problem);
  EXPECT_THAT(result.arcs, ::testing::ElementsAre(::testing::ElementsAre(1, 1)));
  EXPECT_EQ(result.cost, 1);
}

TEST(SolveGreedy, LeavesArcsThatDoNotPay) {
  EXPECT_TRUE(solve_greedy(support::useless_arc().problem).arcs.empty());
}

TEST(SolveGreedy, CoversWhatMustBeCoveredFirst) {
  // (2,2) at -5 alone would be cheaper; index 1 of dimension 1 must be covered.
  const BaselineResult result = solve_greedy(support::one_forced_index().problem);
  EXPECT_TRUE(result.feasible);
  EXPECT_EQ(result.cost, 5);
}

TEST(SolveGreedy, SaysSoWhenItFindsNothingFeasible) {
  // Greedy takes (1,1) at 0 and leaves row 2 and column 2, which have no arc.
  const Problem problem =
      support::make_problem({2, 2}, {{{1, 1}, 0}, {{1, 2}, 1}, {{2, 1}, 1}}, kInfinity);
  const BaselineResult result = solve_greedy(problem);
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(result.cost, kInfinity);
  EXPECT_TRUE(support::brute_force(problem));
}

// What holds of every heuristic, on random problems of every kind.
void check_answer(const support::RandomCase& instance, const BaselineResult& result) {
  EXPECT_EQ(result.feasible, support::infeasibility(instance.problem, result.arcs).empty());
  EXPECT_THAT(result, HasCost(instance.problem, 0));
  if (instance.options.singletons == support::SingletonKind::kFree ||
      instance.options.singletons == support::SingletonKind::kPriced) {
    EXPECT_TRUE(result.feasible);
  }
  const auto optimum = support::brute_force(instance.problem);
  if (!optimum) {
    EXPECT_FALSE(result.feasible);
  } else {
    EXPECT_GE(result.cost, optimum->cost);
  }
}

TEST(Heuristics, ReturnFeasibleSolutionsAndTheirCost) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    SCOPED_TRACE(instance.description);
    check_answer(instance, solve_greedy(instance.problem));
    check_answer(instance, solve_randomized_greedy(instance.problem, {10, 3, seed}));
    check_answer(instance, solve_max_regret(instance.problem));
    check_answer(instance, solve_sgts(instance.problem));
  }
}

TEST(SolveRandomizedGreedy, IsNeverWorseThanGreedyAndEqualsItWithOneCandidate) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    SCOPED_TRACE(instance.description);
    const BaselineResult greedy = solve_greedy(instance.problem);
    EXPECT_LE(solve_randomized_greedy(instance.problem, {5, 4, seed}).cost, greedy.cost);
    EXPECT_EQ(solve_randomized_greedy(instance.problem, {5, 1, seed}).arcs, greedy.arcs);
  }
}

TEST(SolveRandomizedGreedy, FindsWhatGreedyMisses) {
  const Problem problem = support::crossing_tracks().problem;
  EXPECT_EQ(solve_randomized_greedy(problem, {50, 2, 1}).cost, -8);
}

TEST(SolveRandomizedGreedy, GivesTheSameAnswerForTheSameSeed) {
  support::RandomProblemOptions options;
  options.sizes = {20, 20, 20};
  options.num_arcs = 400;
  const Problem problem = support::random_problem(3, options);
  const RandomizedGreedyOptions few{5, 5, 9};
  EXPECT_EQ(solve_randomized_greedy(problem, few).arcs, solve_randomized_greedy(problem, few).arcs);
}

TEST(SolveRandomizedGreedy, RejectsOptionsOutOfRange) {
  const Problem problem = support::one_arc().problem;
  EXPECT_THROW(solve_randomized_greedy(problem, {0, 3, 1}), InputError);
  EXPECT_THROW(solve_randomized_greedy(problem, {3, 0, 1}), InputError);
}

}  // namespace
}  // namespace nda
