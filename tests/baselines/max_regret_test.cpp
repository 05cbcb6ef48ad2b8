#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "nda/baselines.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

TEST(SolveMaxRegret, AvoidsTheMistakeOfGreedy) {
  // Index 2 of dimension 1 loses 2 without (2,2,2), index 1 only 1 without (1,1,2).
  EXPECT_EQ(solve_max_regret(support::crossing_tracks().problem).cost, -8);
}

TEST(SolveMaxRegret, SolvesPerfectProblemsWhereGreedyIsShortSighted) {
  // Greedy: (1,1) 0, then (2,2) 9.  Row 2 and column 2 regret most: (2,1) 1 and (1,2) 1.
  const Problem problem = support::make_problem(
      {2, 2}, {{{1, 1}, 0}, {{1, 2}, 1}, {{2, 1}, 1}, {{2, 2}, 9}}, kInfinity);
  EXPECT_EQ(solve_greedy(problem).cost, 9);
  EXPECT_EQ(solve_max_regret(problem).cost, 2);
}

// The definition taken literally: all regrets anew at every step.  Free singletons only.
std::vector<std::vector<Index>> naive_max_regret(const Problem& problem) {
  std::vector<std::vector<Index>> chosen;
  while (true) {
    double largest = -1;
    std::optional<std::size_t> best_arc;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        std::vector<std::pair<double, std::size_t>> choices;
        for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
          if (problem.indices(k)[a] != i || problem.costs()[a] >= 0) continue;
          support::Tuples with = chosen;
          with.push_back(problem.arc(a));
          if (support::infeasibility(problem, with).empty())
            choices.push_back({problem.costs()[a], a});
        }
        if (choices.empty()) continue;
        std::sort(choices.begin(), choices.end());
        const double second = choices.size() > 1 ? choices[1].first : 0;
        if (second - choices[0].first <= largest) continue;
        largest = second - choices[0].first;
        best_arc = choices[0].second;
      }
    }
    if (!best_arc) break;
    chosen.push_back(problem.arc(*best_arc));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

TEST(SolveMaxRegret, FollowsItsDefinition) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.sizes = {3, 4, 2, 4};
    options.num_arcs = 30;
    options.sign = support::SignKind::kMixed;
    options.costs = seed % 2 == 0 ? support::CostKind::kInteger : support::CostKind::kFew;
    const Problem problem = support::random_problem(seed, options);
    EXPECT_EQ(solve_max_regret(problem).arcs, naive_max_regret(problem));
  }
}

}  // namespace
}  // namespace nda
