#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "support/matchers.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using support::TinyProblem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr double kTie = 1e-9;

struct Way {
  const char* name;
  Options options;
};

std::vector<Way> exact_ways() {
  std::vector<Way> ways(4);
  ways[0].name = "default";
  ways[1] = {"exact", preset("exact")};
  ways[2].name = "branching";
  ways[2].options.branch.exact_arcs = 0;
  ways[2].options.search.local_search = false;
  ways[2].options.relaxation.max_evaluations = 2;
  ways[3].name = "kExact";
  ways[3].options.method = Method::kExact;
  return ways;
}

class TinyProblems : public ::testing::TestWithParam<TinyProblem> {};

TEST_P(TinyProblems, AreSolvedToTheOptimum) {
  const TinyProblem& tiny = GetParam();
  for (const Way& way : exact_ways()) {
    SCOPED_TRACE(way.name);
    const Solution solution = solve(tiny.problem, way.options);
    const CheckReport report = check(tiny.problem, solution);
    EXPECT_THAT(report.faults, IsEmpty());
    if (!tiny.optimum) {
      EXPECT_EQ(solution.status, Status::kInfeasible);
      EXPECT_EQ(solution.cost, kInfinity);
      EXPECT_EQ(solution.lower_bound, kInfinity);
      EXPECT_THAT(solution.solutions, IsEmpty());
      EXPECT_THAT(solution.multipliers, IsEmpty());
      EXPECT_EQ(solution.stats.certificate_bound, -kInfinity) << "there are no multipliers";
      EXPECT_TRUE(solution.stats.bound_by_branching);
      EXPECT_FALSE(solution.proven);
      EXPECT_THAT(solution.reason, Not(IsEmpty()));
      continue;
    }
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_TRUE(solution.proven);
    EXPECT_THAT(solution.reason, IsEmpty());
    EXPECT_NEAR(solution.cost, *tiny.optimum, kTie);
    EXPECT_NEAR(solution.lower_bound, *tiny.optimum, kTie);
    ASSERT_EQ(solution.solutions.size(), 1u);
    EXPECT_TRUE(solution.solutions[0].proven);
    EXPECT_EQ(solution.solutions[0].rank, 1);
    EXPECT_THAT(solution.solutions[0].arcs, support::IsFeasibleFor(tiny.problem));
    EXPECT_TRUE(
        std::is_sorted(solution.solutions[0].arcs.begin(), solution.solutions[0].arcs.end()));
  }
}

TEST_P(TinyProblems, HaveACertificateOfTheLpValueAtBest) {
  const TinyProblem& tiny = GetParam();
  if (!tiny.optimum) return;
  const Solution solution = solve(tiny.problem);
  EXPECT_LE(solution.stats.certificate_bound, *tiny.lp_value + kTie);
  EXPECT_NEAR(solution.stats.certificate_bound, *tiny.lp_value, 0.01);
  EXPECT_EQ(solution.stats.bound_by_branching, *tiny.optimum > *tiny.lp_value + 0.1);
}

TEST_P(TinyProblems, KeepTheirSizesInTheSolution) {
  const TinyProblem& tiny = GetParam();
  const Solution solution = solve(tiny.problem);
  EXPECT_THAT(solution.sizes, ::testing::ElementsAreArray(tiny.problem.sizes()));
  EXPECT_EQ(solution.num_arcs, tiny.problem.num_arcs());
  EXPECT_EQ(solution.components.size(), solution.num_components);
  std::size_t arcs = 0;
  for (const ComponentReport& component : solution.components) arcs += component.num_arcs;
  EXPECT_EQ(arcs, solution.stats.arcs_after_shift);
}

INSTANTIATE_TEST_SUITE_P(All,
                         TinyProblems,
                         ::testing::ValuesIn(support::all_tiny_problems()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Infeasible, ByCountingNamesWhoSharesWhat) {
  EXPECT_THAT(
      solve(support::infeasible_by_counting().problem).reason,
      HasSubstr("indices 1, 2 of dimension 1 cannot all be covered: each of their arcs uses "
                "index 1 of dimension 2"));
}

TEST(Infeasible, NamesTheIndexWithoutArcs) {
  const Problem problem =
      support::make_problem({2, 2}, {{{1, 1}, 1}, {{2, 0}, kInfinity}, {{1, 2}, -1}});
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_THAT(solution.reason,
              HasSubstr("index 2 of dimension 1 has no arc and its singleton is forbidden"));
}

// An index without arcs settles it even when no time is left to search.
TEST(Infeasible, IsKnownAtOnceWhereAnIndexHasNoArc) {
  const Problem problem = support::make_problem({1, 1}, {}, kInfinity);
  Options options;
  options.time_limit_s = 1e-9;
  EXPECT_EQ(solve(problem, options).status, Status::kInfeasible);
}

// Two rows and one column, all to be covered; beside them two rows that can be paired.
TEST(Infeasible, IsSaidOfTheComponentThatIs) {
  const Problem problem = support::make_problem(
      {4, 3}, {{{1, 1}, 3}, {{2, 1}, 4}, {{1, 0}, kInfinity}, {{2, 0}, kInfinity}, {{3, 2}, -1}});
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::kInfeasible);
  ASSERT_EQ(solution.components.size(), 2u);
  EXPECT_EQ(solution.components[0].status, Status::kInfeasible);
  EXPECT_EQ(solution.components[0].cost, kInfinity);
  EXPECT_EQ(solution.components[0].lower_bound, kInfinity);
  EXPECT_FALSE(solution.components[0].proven);
  EXPECT_EQ(solution.components[1].status, Status::kOptimal);
  EXPECT_EQ(solution.components[1].cost, -1);
  EXPECT_TRUE(solution.components[1].proven);
}

TEST(Reports, AddUpToTheWhole) {
  Options options;
  options.search.reductions = Reductions::kNone;
  const Solution solution = solve(support::two_components().problem, options);
  ASSERT_EQ(solution.components.size(), 2u);
  double cost = 0;
  double lower_bound = 0;
  std::size_t indices = 0;
  for (const ComponentReport& component : solution.components) {
    EXPECT_EQ(component.num_arcs, 2u);
    EXPECT_TRUE(component.proven);
    EXPECT_EQ(component.status, Status::kOptimal);
    EXPECT_STREQ(component.method.c_str(), "enumeration");
    cost += component.cost;
    lower_bound += component.lower_bound;
    indices += component.num_indices;
  }
  EXPECT_NEAR(cost, -5, kTie);
  EXPECT_NEAR(lower_bound, -5, kTie);
  EXPECT_EQ(indices, 6u);
}

TEST(Reports, NameTheAssignmentOfTwoDimensions) {
  const Solution solution = solve(support::square_2d().problem);
  ASSERT_EQ(solution.components.size(), 1u);
  EXPECT_EQ(solution.components[0].method, "assignment");
  EXPECT_FALSE(solution.stats.bound_by_branching);
}

TEST(Reports, CountTheWork) {
  Options options;
  options.branch.exact_arcs = 0;
  const Solution solution = solve(support::odd_cycle().problem, options);
  EXPECT_GT(solution.stats.dual_evaluations, 0);
  EXPECT_GT(solution.stats.recoveries, 0);
  EXPECT_GT(solution.stats.nodes, 0);
  EXPECT_GT(solution.stats.solve_seconds, 0);
  EXPECT_GT(solution.stats.peak_memory_bytes, 1000000u);
  EXPECT_TRUE(solution.stats.bound_by_branching);
  EXPECT_EQ(solution.components.at(0).method, "slack search");
}

TEST(Solve, RefusesAProblemThatWasMovedFrom) {
  Problem problem = support::odd_cycle().problem;
  const Problem moved = std::move(problem);
  EXPECT_THROW(solve(problem), InputError);
}

}  // namespace
}  // namespace nda
