#include "reduce/arc_pool.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "reduce/reduce_support.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Slots: dimension 1 has 0..2, dimension 2 has 3..5.
core::Component square() {
  return make({2, 2}, {{{0, 1}, 2}, {{1, 1}, -3}, {{1, 2}, -2}, {{2, 2}, -5}});
}

TEST(ArcPool, HoldsTheArcsThatPay) {
  ArcPool pool;
  pool.reset(square());
  EXPECT_EQ(pool.num_alive(), 3);
  EXPECT_FALSE(pool.alive(0));
  EXPECT_THAT(pool.slots(1), ElementsAre(1, 4));
  EXPECT_THAT(pool.arcs_at(1), ElementsAre(1, 2));
  EXPECT_THAT(pool.arcs_at(4), ElementsAre(1));
}

TEST(ArcPool, ForgetsWhatIsDropped) {
  ArcPool pool;
  pool.reset(square());
  pool.drop(1);
  pool.drop(1);
  EXPECT_EQ(pool.num_alive(), 2);
  EXPECT_THAT(pool.arcs_at(1), ElementsAre(2));
  EXPECT_THAT(pool.arcs_at(4), IsEmpty());
}

TEST(ArcPool, ChargesAnIndexAndDropsWhatDoesNotPayAnyMore) {
  ArcPool pool;
  pool.reset(square());
  EXPECT_EQ(pool.charge(5, -2), 1);
  EXPECT_FALSE(pool.alive(2));
  EXPECT_EQ(pool.cost(3), -3);
  EXPECT_EQ(pool.cost(1), -3);
  EXPECT_EQ(pool.charges()[5], -2);
}

TEST(ArcPool, HidesARelievedIndex) {
  ArcPool pool;
  pool.reset(square());
  pool.relieve(5);
  EXPECT_THAT(pool.slots(2), ElementsAre(1));
  EXPECT_THAT(pool.slots(3), ElementsAre(2));
  EXPECT_THAT(pool.arcs_at(5), IsEmpty());
}

TEST(ArcPool, UndoesChoicesLastFirst) {
  const core::Component component = square();
  ArcPool pool;
  pool.reset(component);
  pool.choose(std::array<core::ArcId, 1>{2});
  pool.choose(std::array<core::ArcId, 1>{3}, std::array<core::ArcId, 1>{1});
  EXPECT_THAT(pool.restore(component, {}).arcs, ElementsAre(3)) << "then 2 has no room";
  EXPECT_THAT(pool.restore(component, {2}).arcs, ElementsAre(1, 2)) << "the other choice";
  EXPECT_THAT(pool.restore(component, {1}).arcs, ElementsAre(1, 3));
  EXPECT_EQ(pool.restore(component, {}).cost, -5);
}

TEST(ArcPool, StartsAfreshEveryTime) {
  ArcPool pool;
  pool.reset(square());
  pool.charge(1, -1);
  pool.relieve(5);
  pool.choose(std::array<core::ArcId, 1>{3});
  pool.reset(square());
  EXPECT_EQ(pool.num_alive(), 3);
  EXPECT_THAT(pool.slots(3), ElementsAre(2, 5));
  EXPECT_EQ(support::sum_of(pool.charges()), 0);
  EXPECT_THAT(pool.restore(square(), {}).arcs, IsEmpty());
}

}  // namespace
}  // namespace nda::reduce
