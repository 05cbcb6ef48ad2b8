#include "kbest/ranks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/tiny_problems.hpp"

namespace nda::kbest {
namespace {

constexpr double kFar = -1e12;

// One arc of the cost kFar, and beside it a problem whose costs are whole numbers below 100: its
// optimum is a question of 1e-12 of the cost.
Problem small_beside_large(std::uint64_t seed) {
  core::Random random(seed);
  support::Arcs arcs = {{{1, 1, 1}, kFar}};
  const auto index = [&] { return static_cast<Index>(2 + random.below(6)); };
  std::set<std::vector<Index>> tuples;
  while (tuples.size() < 80) tuples.insert({index(), index(), index()});
  for (const std::vector<Index>& tuple : tuples)
    arcs.push_back({tuple, -1.0 - static_cast<double>(random.below(99))});
  return support::make_problem({7, 7, 7}, arcs);
}

TEST(Ranks, CallsNothingOptimalThatAStepOfTheGridCouldBeat) {
  Options options;
  options.method = Method::kRelaxation;
  options.search.kicks_per_index = 0;
  int improved = 0, missed = 0;
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    SCOPED_TRACE(seed);
    options.relaxation.max_evaluations = seed % 2 == 0 ? 1 : 60;
    const Problem problem = small_beside_large(seed);
    const double best = solve(problem).cost;
    const double plain = solve(problem, options).cost;
    const Solution solution = solve_k_best(problem, 3, options);
    if (solution.proven) {
      EXPECT_EQ(solution.cost, best);
    }
    improved += solution.cost < plain;
    missed += solution.cost < plain && solution.cost > best;
  }
  EXPECT_GT(improved, 20);
  EXPECT_GT(missed, 10);
}

// Two arcs that exclude each other, the first one better.
Solution first_of(const Problem& problem, double cost, double lower_bound) {
  Solution solution;
  solution.status = Status::kNodeLimit;
  solution.cost = cost + 1;
  solution.lower_bound = lower_bound;
  adopt(problem, solution, {{1, cost, false, {}}});
  EXPECT_EQ(solution.cost, cost);
  EXPECT_EQ(solution.solutions.front().proven, solution.proven);
  EXPECT_EQ(solution.status, solution.proven ? Status::kOptimal : Status::kNodeLimit);
  return solution;
}

TEST(Ranks, ProvesWhatTheBoundMeets) {
  const Problem whole = support::make_problem({2, 2}, {{{1, 1}, -3e9}, {{1, 2}, -1}});
  EXPECT_TRUE(first_of(whole, -3e9, -3e9).proven);
  EXPECT_TRUE(first_of(whole, -3e9, -3e9 - 0.9).proven) << "nothing lies between whole numbers";
  EXPECT_FALSE(first_of(whole, -3e9, -3e9 - 1).proven) << "1 is less than 1e-9 of the cost";
  const Problem real = support::make_problem({2, 2}, {{{1, 1}, -1.0 / 3}, {{1, 2}, -1.0 / 7}});
  EXPECT_TRUE(first_of(real, -1.0 / 3, -1.0 / 3).proven);
  EXPECT_FALSE(first_of(real, -1.0 / 3, -1.0 / 3 - 1e-10).proven);
}

// Near the best there may be what costs less by rounding and was not listed.
TEST(Ranks, ListsTheBestFirstThoughItBeatsTheProvenByRoundingAlone) {
  const double less = std::nextafter(-4.0, -5.0);
  const Problem problem =
      support::make_problem({3, 3}, {{{1, 1}, -4}, {{1, 2}, less}, {{2, 2}, -1.0 / 3}});
  Solution solution;
  solution.status = Status::kOptimal;
  solution.proven = true;
  solution.cost = -4;
  solution.lower_bound = less;
  adopt(problem, solution, {{1, -4, true, {{1, 1}}}, {2, less, false, {{1, 2}}}});
  EXPECT_EQ(solution.cost, less);
  EXPECT_EQ(solution.status, Status::kOptimal);
  ASSERT_EQ(solution.solutions.size(), 2u);
  EXPECT_EQ(solution.solutions[0].cost, less);
  EXPECT_EQ(solution.solutions[1].cost, -4);
  for (int r = 0; r < 2; ++r)
    EXPECT_EQ(solution.solutions[static_cast<std::size_t>(r)].rank, r + 1);
  EXPECT_TRUE(solution.solutions.front().proven);
}

}  // namespace
}  // namespace nda::kbest
