#include "nda/solution.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace nda {
namespace {

Solution bracket(double lower_bound, double cost) {
  Solution solution;
  solution.lower_bound = lower_bound;
  solution.cost = cost;
  return solution;
}

TEST(Status, HasTheNamesOfTheFileFormat) {
  EXPECT_STREQ(to_string(Status::kOptimal), "optimal");
  EXPECT_STREQ(to_string(Status::kGapReached), "gap_reached");
  EXPECT_STREQ(to_string(Status::kTimeLimit), "time_limit");
  EXPECT_STREQ(to_string(Status::kIterationLimit), "iteration_limit");
  EXPECT_STREQ(to_string(Status::kNodeLimit), "node_limit");
  EXPECT_STREQ(to_string(Status::kInterrupted), "interrupted");
  EXPECT_STREQ(to_string(Status::kInfeasible), "infeasible");
  EXPECT_STREQ(to_string(Status::kPrecisionLost), "precision_lost");
}

TEST(Solution, SaysNothingBeforeASolve) {
  const Solution solution;
  EXPECT_EQ(solution.cost, kInfinity);
  EXPECT_EQ(solution.lower_bound, -kInfinity);
  EXPECT_FALSE(solution.proven);
  EXPECT_EQ(solution.gap(), kInfinity);
  EXPECT_EQ(solution.relative_gap(), kInfinity);
}

TEST(Solution, GapIsCostMinusBound) {
  EXPECT_EQ(bracket(-12, -10).gap(), 2);
  EXPECT_DOUBLE_EQ(bracket(-12, -10).relative_gap(), 0.2);
  EXPECT_EQ(bracket(5, 5).gap(), 0);
  EXPECT_EQ(bracket(5, 5).relative_gap(), 0);
}

TEST(Solution, GapIsInfiniteWhenEitherIs) {
  EXPECT_EQ(bracket(-kInfinity, -10).gap(), kInfinity);
  EXPECT_EQ(bracket(3, kInfinity).gap(), kInfinity);
  EXPECT_EQ(bracket(kInfinity, kInfinity).gap(), kInfinity) << "infeasible";
}

TEST(Solution, RelativeGapOfASmallCostIsRelativeToOneBillionth) {
  EXPECT_DOUBLE_EQ(bracket(-1e-9, 0).relative_gap(), 1);
  EXPECT_DOUBLE_EQ(bracket(-2e-10, 1e-10).relative_gap(), 0.3);
}

}  // namespace
}  // namespace nda
