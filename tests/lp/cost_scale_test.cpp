#include "lp/cost_scale.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace nda::lp {
namespace {

TEST(CostScale, LeavesOrdinaryCostsAlone) {
  EXPECT_EQ(cost_scale(0, 0), 1);
  EXPECT_EQ(cost_scale(1, 0), 1);
  EXPECT_EQ(cost_scale(1e5, 1e9), 1);
}

TEST(CostScale, BringsOthersToAHundredOrTwo) {
  for (const double dearest : {1e-290, 1e-12, 0.99, 1.1e5, 1e30, 1e100}) {
    const double scaled = dearest * cost_scale(dearest, 0);
    EXPECT_GE(scaled, 128) << dearest;
    EXPECT_LT(scaled, 256) << dearest;
  }
  EXPECT_TRUE(std::isfinite(cost_scale(std::numeric_limits<double>::denorm_min(), 0)));
}

// 1e25 would end the program.
TEST(CostScale, KeepsPenaltiesBelowWhatTheSolverTakes) {
  for (const double penalty : {1e18, 1e30, 1e120}) {
    EXPECT_LT(penalty * cost_scale(1, penalty), 1e21) << penalty;
    EXPECT_LT(penalty * cost_scale(1e-12, penalty), 1e21) << penalty;
  }
}

}  // namespace
}  // namespace nda::lp
