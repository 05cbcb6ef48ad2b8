#include "support/matchers.hpp"

#include <gtest/gtest.h>

#include "nda/solution.hpp"
#include "support/tiny_problems.hpp"

namespace nda::support {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Infeasibility, NamesTheFault) {
  const Problem problem = crossing_tracks().problem;
  EXPECT_EQ(infeasibility(problem, {{1, 1, 1}, {2, 2, 2}}), "");
  EXPECT_EQ(infeasibility(problem, {}), "");
  EXPECT_THAT(infeasibility(problem, {{1, 1, 1}, {1, 1, 2}}), HasSubstr("used too often"));
  EXPECT_THAT(infeasibility(problem, {{1, 2, 1}}), HasSubstr("no arc"));
  EXPECT_THAT(infeasibility(one_forced_index().problem, {{2, 2}}),
              HasSubstr("index 1 of dimension 1 is used too rarely"));
}

TEST(CostOf, CountsTheSingletonsOfUncoveredIndices) {
  EXPECT_EQ(cost_of(priced_odd_cycle().problem, {{1, 1, 0}}), 2);
  EXPECT_EQ(cost_of(priced_odd_cycle().problem, {}), 3);
  EXPECT_EQ(cost_of(one_forced_index().problem, {}), kInfinity);
}

TEST(Matchers, TellRightFromWrong) {
  const Problem problem = crossing_tracks().problem;
  const RankedSolution right{1, -8, true, {{1, 1, 1}, {2, 2, 2}}};
  const RankedSolution wrong{1, -8, true, {{1, 1, 1}, {1, 1, 2}}};
  EXPECT_THAT(right.arcs, IsFeasibleFor(problem));
  EXPECT_THAT(wrong.arcs, Not(IsFeasibleFor(problem)));
  EXPECT_THAT(right, HasCost(problem, 1e-9));
  EXPECT_THAT(wrong, Not(HasCost(problem, 0.5)));
  Solution solution;
  solution.cost = -7;
  solution.lower_bound = -8.5;
  EXPECT_THAT(solution, BracketsOptimum(-8));
  EXPECT_THAT(solution, Not(BracketsOptimum(-6.9)));
  EXPECT_THAT(solution, Not(BracketsOptimum(-8.6)));
}

}  // namespace
}  // namespace nda::support
