#include "nda/warm_start.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nda {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

WarmStart three_scans() {
  return {{{1, 2}, {3}, {4, 5, 6}}, {{1, 1, 1}, {2, 0, 0}, {0, 0, 3}}};
}

TEST(WarmStart, DropsTheFirstDimensionsAndGainsUnknownOnes) {
  WarmStart warm = three_scans();
  warm.shift(1);
  EXPECT_THAT(warm.multipliers, ElementsAre(ElementsAre(3), ElementsAre(4, 5, 6), IsEmpty()));
  EXPECT_THAT(warm.arcs, ElementsAre(ElementsAre(1, 1, 0), ElementsAre(0, 3, 0)));
}

TEST(WarmStart, KeepsTheListOfTracks) {
  WarmStart warm = three_scans();
  warm.shift(1, 1);
  EXPECT_THAT(warm.multipliers, ElementsAre(ElementsAre(1, 2), ElementsAre(4, 5, 6), IsEmpty()));
  EXPECT_THAT(warm.arcs,
              ElementsAre(ElementsAre(1, 1, 0), ElementsAre(2, 0, 0), ElementsAre(0, 3, 0)));
}

TEST(WarmStart, ForgetsAllWhereNothingOverlaps) {
  for (const int dimensions : {3, 4, 1000000}) {
    WarmStart warm = three_scans();
    warm.shift(dimensions);
    EXPECT_THAT(warm.multipliers, ElementsAre(IsEmpty(), IsEmpty(), IsEmpty()));
    EXPECT_THAT(warm.arcs, IsEmpty());
  }
}

TEST(WarmStart, StaysAsItIsWithoutAMove) {
  WarmStart warm = three_scans();
  warm.shift(0);
  EXPECT_EQ(warm.multipliers, three_scans().multipliers);
  EXPECT_EQ(warm.arcs, three_scans().arcs);
  warm.shift(2, 5);
  EXPECT_EQ(warm.multipliers, three_scans().multipliers);
}

TEST(WarmStart, RefusesNegativeMoves) {
  WarmStart warm = three_scans();
  EXPECT_THROW(warm.shift(-1), InputError);
  EXPECT_THROW(warm.shift(1, -1), InputError);
  EXPECT_EQ(warm.arcs, three_scans().arcs);
}

TEST(WarmStart, IsThatOfTheBestSolution) {
  Solution solution;
  EXPECT_TRUE(warm_start(solution).empty());
  solution.multipliers = {{-1}, {0}};
  solution.solutions = {{1, -1, true, {{1, 1}}}, {2, 0, true, {}}};
  EXPECT_EQ(warm_start(solution).multipliers, solution.multipliers);
  EXPECT_THAT(warm_start(solution).arcs, ElementsAre(ElementsAre(1, 1)));
}

}  // namespace
}  // namespace nda
