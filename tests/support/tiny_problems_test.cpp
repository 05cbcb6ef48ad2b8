#include "support/tiny_problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/brute_force.hpp"

namespace nda::support {
namespace {

class TinyProblems : public ::testing::TestWithParam<TinyProblem> {};

TEST_P(TinyProblems, HaveTheOptimumAndTheSecondBestOfTheirComments) {
  const TinyProblem& tiny = GetParam();
  const auto best = brute_force(tiny.problem);
  ASSERT_EQ(best.has_value(), tiny.optimum.has_value());
  const std::vector<double> costs = all_costs(tiny.problem);
  EXPECT_EQ(costs.empty(), !tiny.optimum);
  if (tiny.optimum) {
    EXPECT_DOUBLE_EQ(best->cost, *tiny.optimum);
    EXPECT_DOUBLE_EQ(costs[0], *tiny.optimum);
  }
  ASSERT_EQ(costs.size() >= 2, tiny.second_best.has_value());
  if (tiny.second_best) {
    EXPECT_DOUBLE_EQ(costs[1], *tiny.second_best);
  }
}

// sum u + sum over arcs and singletons of min(0, c - sum of u over it)
double dual_value(const Problem& problem, const std::vector<std::vector<double>>& u) {
  double value = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      const double multiplier = u[static_cast<std::size_t>(k)][i - 1];
      value += multiplier + std::min(0.0, problem.singleton_costs(k)[i] - multiplier);
    }
  }
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    double reduced = problem.costs()[a];
    const std::vector<Index> tuple = problem.arc(a);
    for (std::size_t k = 0; k < tuple.size(); ++k) reduced -= tuple[k] ? u[k][tuple[k] - 1] : 0;
    value += std::min(0.0, reduced);
  }
  return value;
}

TEST_P(TinyProblems, HaveADualSolutionOfTheLpValue) {
  const TinyProblem& tiny = GetParam();
  if (!tiny.lp_value) return;
  EXPECT_DOUBLE_EQ(dual_value(tiny.problem, tiny.dual), *tiny.lp_value);
}

TEST_P(TinyProblems, HaveAPrimalLpSolutionOfTheLpValue) {
  const TinyProblem& tiny = GetParam();
  if (!tiny.lp_value) return;
  const Problem& problem = tiny.problem;
  ASSERT_EQ(tiny.fraction.size(), problem.num_arcs());
  double cost = 0;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a)
    cost += tiny.fraction[a] * problem.costs()[a];
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      double left = 1;
      for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
        if (problem.indices(k)[a] == i) left -= tiny.fraction[a];
      }
      ASSERT_GE(left, 0) << "index " << i << " of dimension " << k + 1;
      if (left > 0) cost += left * problem.singleton_costs(k)[i];
    }
  }
  EXPECT_DOUBLE_EQ(cost, *tiny.lp_value);
}

INSTANTIATE_TEST_SUITE_P(All,
                         TinyProblems,
                         ::testing::ValuesIn(all_tiny_problems()),
                         [](const auto& tested) { return tested.param.name; });

TEST(MakeProblem, FillsInTheSingletonsThatWereNotGiven) {
  const Problem problem = make_problem({1, 2}, {{{0, 2}, 7}, {{1, 1}, 3}}, 5);
  EXPECT_THAT(problem.singleton_costs(0), ::testing::ElementsAre(0, 5));
  EXPECT_THAT(problem.singleton_costs(1), ::testing::ElementsAre(0, 5, 7));
}

}  // namespace
}  // namespace nda::support
