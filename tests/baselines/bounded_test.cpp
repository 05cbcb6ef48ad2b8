#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nda/baselines.hpp"
#include "support/brute_force.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"

// Baselines on problems with bounds on uses.

namespace nda {
namespace {

using support::HasCost;
using support::IsFeasibleFor;

TEST(SolveBruteForce, AgreesWithTheJudgeOnBoundsOnUses) {
  int num_feasible = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    const support::RandomCase instance = support::random_bounded_case(seed);
    SCOPED_TRACE(instance.description);
    const auto expected = support::brute_force(instance.problem);
    const BaselineResult result = solve_brute_force(instance.problem);
    ASSERT_EQ(result.feasible, expected.has_value());
    if (!expected) continue;
    ++num_feasible;
    EXPECT_NEAR(result.cost, expected->cost, 1e-12);
    EXPECT_THAT(result.arcs, IsFeasibleFor(instance.problem));
    EXPECT_THAT(result, HasCost(instance.problem, 1e-12));
  }
  EXPECT_GT(num_feasible, 2000);
}

// Bounds that say the same as none: 1..1 but for one index without arcs and cost.
Problem with_a_free_index(const Problem& problem) {
  std::vector<Index> sizes(problem.sizes().begin(), problem.sizes().end());
  const Index added = ++sizes[0];
  ProblemBuilder builder(sizes);
  for (std::size_t a = 0; a < problem.num_arcs(); ++a)
    builder.add_arc(problem.arc(a), problem.costs()[a]);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      std::vector<Index> tuple(sizes.size(), 0);
      tuple[static_cast<std::size_t>(k)] = i;
      builder.add_arc(tuple, problem.singleton_costs(k)[i]);
    }
  }
  builder.set_use_bounds(0, added, {0, 2});
  return std::move(builder).build();
}

TEST(Baselines, GiveTheSameAnswersWhereBoundsSayNothing) {
  int num_small = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    SCOPED_TRACE(instance.description);
    const Problem& plain = instance.problem;
    const Problem bounded = with_a_free_index(plain);
    ASSERT_TRUE(bounded.is_many_to_one());
    EXPECT_EQ(solve_greedy(bounded).arcs, solve_greedy(plain).arcs);
    if (plain.num_arcs() > 16) continue;
    ++num_small;
    const double size = support::brute_force(plain) ? solve_brute_force(plain).cost : 0;
    const BaselineResult best = solve_brute_force(bounded);
    EXPECT_EQ(best.feasible, solve_brute_force(plain).feasible);
    if (best.feasible) {
      EXPECT_NEAR(best.cost, size, 1e-12 * std::abs(size));
    }
  }
  EXPECT_GT(num_small, 1000);
}

TEST(SolveGreedy, FindsFeasibleSolutionsWithinBounds) {
  int num_best = 0, num_feasible = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase instance = support::random_bounded_case(seed);
    SCOPED_TRACE(instance.description);
    const BaselineResult result = solve_greedy(instance.problem);
    EXPECT_EQ(result.feasible, support::infeasibility(instance.problem, result.arcs).empty());
    if (!result.feasible) continue;
    EXPECT_THAT(result, HasCost(instance.problem, 1e-12));
    const double best = support::brute_force(instance.problem)->cost;
    EXPECT_GE(result.cost, best - 1e-12);
    ++num_feasible;
    num_best += result.cost <= best + 1e-12;
  }
  EXPECT_GT(num_best, num_feasible * 3 / 4);
}

// Two arcs share an index that must be used once and may be used twice, its singleton costs 3: the
// first arc saves that, the second one nothing more.
TEST(SolveGreedy, CountsASingletonOnlyOnce) {
  ProblemBuilder builder({2, 1});
  builder.add_arc({0, 1}, 3);
  builder.add_arc({1, 1}, 1);
  builder.add_arc({2, 1}, 2);
  builder.set_use_bounds(1, 1, {1, 2});
  const BaselineResult result = solve_greedy(std::move(builder).build());
  EXPECT_THAT(result.arcs, ::testing::ElementsAre(::testing::ElementsAre(1, 1)));
  EXPECT_EQ(result.cost, 1);
}

TEST(Baselines, RefuseBoundsTheyDoNotKnow) {
  ProblemBuilder builder({2, 1});
  builder.set_use_bounds(0, 2, {0, 1});
  const Problem problem = std::move(builder).build();
  const auto message = [&](auto solve) -> std::string {
    try {
      solve(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string where =
      " cannot deal with bounds on uses: index 2 of dimension 1 has bounds 0..1";
  EXPECT_EQ(message([](const Problem& p) { solve_max_regret(p); }), "max-regret" + where);
  EXPECT_EQ(message([](const Problem& p) { solve_randomized_greedy(p); }),
            "randomised greedy" + where);
  EXPECT_EQ(message([](const Problem& p) { solve_sgts(p); }),
            "semi-greedy track selection" + where);
  EXPECT_EQ(message([](const Problem& p) { sgts_partitions(p); }),
            "semi-greedy track selection" + where);
}

}  // namespace
}  // namespace nda
