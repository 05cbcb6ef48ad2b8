#include "support/brute_force.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda::support {
namespace {

using ::testing::ElementsAre;

// A second enumeration, over all subsets of arcs: slower, simpler still.
std::vector<double> costs_over_subsets(const Problem& problem) {
  std::vector<double> costs;
  for (std::uint32_t subset = 0; subset < (1u << problem.num_arcs()); ++subset) {
    Tuples arcs;
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      if (subset >> a & 1) arcs.push_back(problem.arc(a));
    }
    if (infeasibility(problem, arcs).empty()) costs.push_back(cost_of(problem, arcs));
  }
  std::sort(costs.begin(), costs.end());
  return costs;
}

TEST(BruteForce, ListsAllSolutionsOfTwoCrossingTracks) {
  EXPECT_THAT(all_costs(crossing_tracks().problem), ElementsAre(-8, -7, -5, -4, -4, -2, 0));
  EXPECT_THAT(brute_force(crossing_tracks().problem)->arcs,
              ElementsAre(ElementsAre(1, 1, 1), ElementsAre(2, 2, 2)));
}

TEST(BruteForce, AgreesWithTheEnumerationOfAllSubsets) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const RandomCase instance = random_case(seed);
    if (instance.problem.num_arcs() > 8) continue;
    ++num_compared;
    SCOPED_TRACE(instance.description);
    const std::vector<double> expected = costs_over_subsets(instance.problem);
    EXPECT_THAT(all_costs(instance.problem), ::testing::Pointwise(::testing::DoubleEq(), expected));
    const auto best = brute_force(instance.problem);
    ASSERT_EQ(best.has_value(), !expected.empty());
    if (best) {
      EXPECT_DOUBLE_EQ(best->cost, expected[0]);
      EXPECT_THAT(best->arcs, IsFeasibleFor(instance.problem));
      EXPECT_THAT(*best, HasCost(instance.problem, 0));
    }
  }
  EXPECT_GT(num_compared, 400);
}

TEST(BruteForce, RefusesToListTooManySolutions) {
  EXPECT_THROW(all_solutions(crossing_tracks().problem, 6), std::length_error);
  EXPECT_EQ(all_solutions(crossing_tracks().problem, 7).size(), 7u);
}

}  // namespace
}  // namespace nda::support
