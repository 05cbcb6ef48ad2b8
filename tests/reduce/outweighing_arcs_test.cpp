#include "reduce/outweighing_arcs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/reduce_support.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// The cross of arcs 0 and 2 against the straight arc 1.
core::Component cross(double straight) {
  return make({2, 2}, {{{1, 1}, -2}, {{1, 2}, straight}, {{2, 2}, -3}});
}

TEST(OutweighingArcs, AreTakenAndExcludeTheirRivals) {
  const core::Component component = cross(-5);
  ArcPool pool;
  pool.reset(component);
  const Takings takings = take_outweighing_arcs(pool);
  EXPECT_EQ(takings.taken, 1);
  EXPECT_EQ(takings.dropped, 2);
  EXPECT_THAT(arcs_alive(pool), IsEmpty());
  EXPECT_THAT(pool.restore(component, {}).arcs, ElementsAre(1));
  EXPECT_EQ(support::sum_of(pool.charges()), -5);
}

TEST(OutweighingArcs, AreNoneWhereRivalsTogetherCostLess) {
  ArcPool pool;
  pool.reset(cross(-4.9));
  EXPECT_EQ(take_outweighing_arcs(pool).taken, 0);
  EXPECT_THAT(arcs_alive(pool), ElementsAre(0, 1, 2));
}

TEST(OutweighingArcs, ShareTheCostOfARivalAmongCommonIndices) {
  // One rival on both indices of arc 0 counts once.
  ArcPool pool;
  pool.reset(make({1, 1, 1}, {{{1, 1, 0}, -3}, {{1, 1, 1}, -3}}));
  const Takings takings = take_outweighing_arcs(pool);
  EXPECT_EQ(takings.taken, 1);
  EXPECT_EQ(takings.dropped, 1);
}

TEST(OutweighingArcs, AreMissedByNoBestPackingAndNoMultipliers) {
  EXPECT_GT(times_equivalent(
                [](ArcPool& pool, std::uint64_t) { return take_outweighing_arcs(pool).taken > 0; }),
            1000);
}

}  // namespace
}  // namespace nda::reduce
