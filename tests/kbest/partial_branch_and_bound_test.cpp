#include "kbest/partial_branch_and_bound.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <stop_token>
#include <vector>

#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/components.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

Options near_optimal(RankingMethod method) {
  Options options;
  options.method = Method::kRelaxation;
  options.relaxation.max_evaluations = 5;
  options.relaxation.recovery_evaluations = 5;
  options.ranking.method = method;
  return options;
}

// Optimum -8: parallel.
TEST(PartialBranchAndBound, SolvesTwoCrossingTracks) {
  const support::TinyProblem tiny = support::crossing_tracks();
  const Solution solution = solve_k_best(tiny.problem, 2, near_optimal(RankingMethod::kMurty));
  EXPECT_DOUBLE_EQ(solution.cost, *tiny.optimum);
  EXPECT_THAT(check(tiny.problem, solution).faults, IsEmpty());
}

// All dimensions of the same size.
Problem four_dimensions(std::uint64_t seed, Index size, int num_arcs) {
  support::RandomProblemOptions random;
  random.sizes = {size, size, size, size};
  random.num_arcs = num_arcs;
  return support::random_problem(seed, random);
}

class PartialRanking : public testing::TestWithParam<RankingMethod> {};
INSTANTIATE_TEST_SUITE_P(Rules,
                         PartialRanking,
                         testing::Values(RankingMethod::kAlignments, RankingMethod::kMurty));

// All solutions sound and different, none better than what enumeration has at its rank, none proven
// but an optimal first, and the best no worse than plain relaxation with as many steps.
TEST_P(PartialRanking, IsSoundAndNoWorseThanPlainRelaxation) {
  int better = 0, many = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    Options options = near_optimal(GetParam());
    options.ranking.branches = 1 + static_cast<int>(seed % 4);
    options.ranking.local_search = seed % 3 == 0;
    const Solution plain = solve(random.problem, options);
    const Solution solution = solve_k_best(random.problem, 6, options);
    EXPECT_THAT(check(random.problem, solution).faults, IsEmpty());
    ASSERT_EQ(solution.solutions.empty(), plain.solutions.empty());
    if (plain.solutions.empty()) continue;
    EXPECT_LE(solution.cost, plain.cost);
    EXPECT_FALSE(solution.lists_all);
    better += solution.cost < plain.cost - 1e-9 * std::abs(plain.cost);
    many += solution.solutions.size() > 1;
    std::set<std::vector<std::vector<Index>>> different;
    for (const RankedSolution& ranked : solution.solutions) {
      EXPECT_TRUE(different.insert(ranked.arcs).second);
      EXPECT_TRUE(!ranked.proven || ranked.rank == 1);
    }
    try {
      const std::vector<double> all = support::all_costs(random.problem, 5000);
      for (std::size_t r = 0; r < solution.solutions.size(); ++r)
        EXPECT_GE(solution.solutions[r].cost, all[r] - 1e-9 * (1 + std::abs(all[r])));
    } catch (const std::length_error&) {  // too many to list
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(better, 5);
  EXPECT_GT(many, 300);
}

// More branches see all that fewer see, where no bound cuts and no buffer is full.
TEST_P(PartialRanking, GainsByBranches) {
  double few = 0, more = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Problem problem = four_dimensions(seed, 6, 250);
    Options options = near_optimal(GetParam());
    options.ranking.branches = 1;
    few += solve_k_best(problem, 5, options).cost;
    options.ranking.branches = 6;
    more += solve_k_best(problem, 5, options).cost;
  }
  EXPECT_LT(more, few);
}

// Local search lists what it was given, too.
TEST_P(PartialRanking, GainsByLocalSearch) {
  double without = 0, with = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Problem problem = four_dimensions(seed, 8, 400);
    Options options = near_optimal(GetParam());
    const Solution found = solve_k_best(problem, 5, options);
    options.ranking.local_search = true;
    const Solution improved = solve_k_best(problem, 5, options);
    ASSERT_LE(improved.solutions.size(), 5u);
    ASSERT_GE(improved.solutions.size(), found.solutions.size());
    for (std::size_t r = 0; r < found.solutions.size(); ++r)
      EXPECT_LE(improved.solutions[r].cost, found.solutions[r].cost);
    without += found.cost;
    with += improved.cost;
  }
  EXPECT_LT(with, without);
}

TEST_P(PartialRanking, StopsWhenAsked) {
  support::RandomProblemOptions random;
  random.sizes = {30, 30, 30, 30, 30};
  random.num_arcs = 6000;
  const Problem problem = support::random_problem(1, random);
  Options options = near_optimal(GetParam());
  options.relaxation.max_evaluations = 200;
  options.ranking.branches = 1000;
  options.time_limit_s = 0.2;
  const auto begin = std::chrono::steady_clock::now();
  const Solution solution = solve_k_best(problem, 100, options);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  ASSERT_FALSE(solution.solutions.empty());
  EXPECT_LT(took.count(), 30) << "it would take hours";
}

// The ranks of what was searched in time, with all else as plain relaxation left it.
TEST_P(PartialRanking, KeepsWhatWasFoundInTime) {
  ProblemBuilder builder({2, 2, 2});
  builder.add_arc({1, 1, 1}, -4);
  builder.add_arc({2, 2, 2}, -5);
  const Problem problem = std::move(builder).build();
  Options options = near_optimal(GetParam());
  options.time_limit_s = 1e-9;
  const Solution solution = solve_k_best(problem, 5, options);
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  ASSERT_EQ(solution.solutions.size(), 1u);
}

// One alignment, that of the end.
TEST(PartialBranchAndBound, WorksWithEveryDualMethod) {
  for (const DualMethod method : {DualMethod::kBundleTrust,
                                  DualMethod::kSubgradient,
                                  DualMethod::kVolume,
                                  DualMethod::kCoordinate}) {
    support::RandomProblemOptions random;
    random.sizes = {6, 6, 6, 6};
    random.num_arcs = 200;
    const Problem problem = support::random_problem(3, random);
    Options options = near_optimal(RankingMethod::kMurty);
    options.relaxation.dual_method = method;
    const Solution solution = solve_k_best(problem, 5, options);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
    EXPECT_EQ(solution.solutions.size(), 5u);
  }
}

// With one step at all other stages only the first one has a choice.
TEST(AlignmentSelection, HoldsAtTheFirstStage) {
  int different = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    support::RandomProblemOptions random;
    random.sizes = {8, 8, 8, 8};
    random.num_arcs = 400;
    const Problem problem = support::random_problem(seed, random);
    Options options;
    options.method = Method::kRelaxation;
    options.relaxation.max_evaluations = 20;
    options.relaxation.recovery_evaluations = 1;
    options.relaxation.recovery_interval = 1000;
    const double by_value = solve(problem, options).cost;
    options.relaxation.alignment = AlignmentRule::kLeastViolation;
    different += solve(problem, options).cost != by_value;
  }
  EXPECT_GT(different, 0);
}

}  // namespace
}  // namespace nda
