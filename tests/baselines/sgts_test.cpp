#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "nda/baselines.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::ElementsAre;
using Arc = std::vector<Index>;

// Six tracks over six measurements that run as in figure 3 of the paper: T1 = {1,3}, T2 = {1,2}, T3
// = {3,5}, T4 = {2,4}, T5 = {2,4,6}, T6 = {4,6}, of weights 10, 9, 8, 7, 6, 5.
Problem six_tracks() {
  return support::make_problem({1, 1, 1, 1, 1, 1},
                               {{{1, 0, 1, 0, 0, 0}, -10},
                                {{1, 1, 0, 0, 0, 0}, -9},
                                {{0, 0, 1, 0, 1, 0}, -8},
                                {{0, 1, 0, 1, 0, 0}, -7},
                                {{0, 1, 0, 1, 0, 1}, -6},
                                {{0, 0, 0, 1, 0, 1}, -5}});
}

TEST(SgtsPartitions, FollowTheExampleOfThePaper) {
  const std::vector<BaselineResult> partitions = sgts_partitions(six_tracks());
  ASSERT_EQ(partitions.size(), 3u);
  EXPECT_EQ(partitions[0].cost, -10 - 7);     // T1, T4
  EXPECT_EQ(partitions[1].cost, -9 - 8 - 5);  // T2, T3, T6
  EXPECT_EQ(partitions[2].cost, -6 - 10);     // T5, then T1
  EXPECT_EQ(solve_sgts(six_tracks()).cost, -22);
}

TEST(SolveSgts, WithOnePartitionIsGreedy) {
  EXPECT_EQ(solve_sgts(six_tracks(), {1}).cost, -17);
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    SCOPED_TRACE(instance.description);
    EXPECT_EQ(solve_sgts(instance.problem, {1}).arcs, solve_greedy(instance.problem).arcs);
  }
}

TEST(SgtsPartitions, AreAllDifferentAndUseEveryImprovingArc) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    support::RandomProblemOptions options;
    options.sizes = {4, 3, 5};
    options.num_arcs = 25;
    options.sign = support::SignKind::kMixed;
    const Problem problem = support::random_problem(seed, options);
    SCOPED_TRACE(seed);
    std::set<std::vector<Arc>> seen;
    std::set<Arc> used;
    for (const BaselineResult& partition : sgts_partitions(problem, {1000})) {
      EXPECT_TRUE(seen.insert(partition.arcs).second);
      used.insert(partition.arcs.begin(), partition.arcs.end());
    }
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      EXPECT_EQ(used.count(problem.arc(a)), problem.costs()[a] < 0 ? 1u : 0u);
    }
  }
}

// S, the cost of leaving every index alone, and the largest number of real indices in an improving
// arc.
std::pair<double, int> all_alone_and_width(const Problem& problem) {
  double alone = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) alone += problem.singleton_costs(k)[i];
  }
  int width = 1;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    int real = 0;
    double shifted = problem.costs()[a];
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      const Index i = problem.indices(k)[a];
      real += i != 0;
      shifted -= problem.singleton_costs(k)[i];
    }
    if (shifted < 0) width = std::max(width, real);
  }
  return {alone, width};
}

TEST(SolveSgts, KeepsTheGuaranteeOfProposition2) {
  int binding = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const support::RandomCase instance = support::random_case(seed);
    if (instance.options.singletons != support::SingletonKind::kFree &&
        instance.options.singletons != support::SingletonKind::kPriced) {
      continue;
    }
    SCOPED_TRACE(instance.description);
    const auto [alone, width] = all_alone_and_width(instance.problem);
    const double optimum = support::brute_force(instance.problem)->cost;
    const double first = alone - solve_sgts(instance.problem, {1}).cost;
    const double best = alone - solve_sgts(instance.problem).cost;
    const double rounding = 1e-9 * (std::abs(alone) + std::abs(optimum));
    EXPECT_LE(alone - optimum, width * first + rounding);
    EXPECT_LE(first, best + rounding);
    binding += alone - optimum > first + rounding;
  }
  EXPECT_GT(binding, 50) << "greedy was optimal nearly always: the property is not tested";
}

TEST(SolveSgts, ShowsThatTheGuaranteeIsSharp) {
  // One arc of weight 1.001 meets four arcs of weight 1, each in one index.
  const Problem problem = support::make_problem({2, 2, 2, 2},
                                                {{{1, 1, 1, 1}, -1.001},
                                                 {{1, 2, 0, 0}, -1},
                                                 {{2, 1, 0, 0}, -1},
                                                 {{0, 0, 1, 2}, -1},
                                                 {{0, 0, 2, 1}, -1}});
  EXPECT_DOUBLE_EQ(solve_sgts(problem, {1}).cost, -1.001);
  EXPECT_DOUBLE_EQ(support::brute_force(problem)->cost, -4);
  EXPECT_DOUBLE_EQ(solve_sgts(problem).cost, -4);  // the second partition finds it
}

TEST(SolveSgts, RejectsOptionsOutOfRange) {
  EXPECT_THROW(solve_sgts(six_tracks(), {0}), InputError);
}

TEST(SgtsPartitions, AreOneEmptyPartitionWithoutArcs) {
  const auto partitions = sgts_partitions(support::no_arcs().problem);
  ASSERT_EQ(partitions.size(), 1u);
  EXPECT_EQ(partitions[0].cost, 6);
  EXPECT_TRUE(partitions[0].arcs.empty());
}

}  // namespace
}  // namespace nda
