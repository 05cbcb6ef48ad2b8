#include <gtest/gtest.h>

#include "dual/maximize.hpp"
#include "support/concave_fakes.hpp"
#include "support/planted_duals.hpp"

namespace nda::dual {
namespace {

TEST(Coordinate, SolvesASeparableFunctionInOneSweep) {
  test::Tents tents({4, -7, 0.5});
  const std::vector<double> start = {0, 0, 0};
  const MaximizeResult result = maximize_coordinate(tents, start, {});
  EXPECT_EQ(result.value, 0);
  EXPECT_EQ(result.point, (std::vector<double>{4, -7, 0.5}));
  EXPECT_EQ(result.reason, StopReason::kConverged);
  EXPECT_LE(result.evaluations, 3);
}

TEST(Coordinate, NeverFallsAndNeedNotReachTheMaximum) {
  bool stuck = false;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    test::PlantedPacking packing({4, 10, 12, 1}, seed);
    double last = -1e300;
    const std::vector<double> start(packing.num_variables());
    const MaximizeResult result = maximize_coordinate(packing, start, {}, [&](const Iterate& it) {
      EXPECT_GE(it.value, last - 1e-9);
      last = it.value;
      return true;
    });
    EXPECT_LE(result.value, packing.maximum() + 1e-9);
    stuck = stuck || (result.reason == StopReason::kConverged &&
                      result.value < packing.maximum() - 1e-3 * -packing.maximum());
  }
  EXPECT_TRUE(stuck) << "coordinate ascent now solves what it is documented not to";
}

}  // namespace
}  // namespace nda::dual
