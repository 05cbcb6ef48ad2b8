#include "reduce/cut_indices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/reduce_support.hpp"
#include "reduce/small_packing.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Slots: dimension 1 has 1..3, dimension 2 has 5..7.  A path: 5 - 1 - 6 - 2 - 7 - 3.
core::Component path() {
  return make({3, 3}, {{{1, 1}, -2}, {{1, 2}, -3}, {{2, 2}, -4}, {{2, 3}, -5}, {{3, 3}, -4}});
}

TEST(SmallPacking, IsSolvedWithAndWithoutItsGate) {
  ArcPool pool;
  pool.reset(path());
  const std::vector<core::ArcId> side = {0, 1};
  SmallPacking packing(pool, side);
  ASSERT_TRUE(packing.solve(6));
  EXPECT_EQ(packing.cost_with(), -3);
  EXPECT_EQ(packing.cost_without(), -2);
  EXPECT_THAT(packing.with(), ElementsAre(1));
  EXPECT_THAT(packing.without(), ElementsAre(0));
  EXPECT_THAT(packing.slots(), ElementsAre(1, 5, 6));
  EXPECT_NEAR(support::sum_of(packing.multipliers()), -2, 1e-12);
}

TEST(SmallPacking, IsNotSolvedWhereItsRelaxationIsNotExact) {
  // A triangle of pairs beside the gate: at most one of them, but half of each pays more.
  ArcPool pool;
  pool.reset(
      make({1, 1, 1, 1},
           {{{0, 0, 1, 1}, -1}, {{0, 1, 1, 0}, -2}, {{1, 0, 1, 0}, -2}, {{1, 1, 0, 0}, -2}}));
  const std::vector<core::ArcId> side = {0, 1, 2, 3};
  SmallPacking packing(pool, side);
  EXPECT_FALSE(packing.solve(7));
}

TEST(CutIndices, LetAPathVanish) {
  const core::Component component = path();
  ArcPool pool;
  pool.reset(component);
  const Cuttings cuttings = cut_sides_off(pool);
  EXPECT_EQ(cuttings.dropped, 5);
  EXPECT_THAT(arcs_alive(pool), IsEmpty());
  EXPECT_EQ(pool.restore(component, {}).cost, support::best_cost(component));
  EXPECT_NEAR(support::sum_of(pool.charges()), support::best_cost(component), 1e-9);
}

TEST(CutIndices, AreMissedByNoBestPackingAndNoMultipliers) {
  EXPECT_GT(
      times_equivalent([](ArcPool& pool, std::uint64_t) { return cut_sides_off(pool).sides > 0; }),
      1000);
}

TEST(CutIndices, StayWhereSidesAreLarge) {
  support::RandomComponentOptions options;
  options.sizes = {4, 4, 4};
  options.num_arcs = 120;
  const core::Component component = support::random_component(1, options);
  ArcPool pool;
  pool.reset(component);
  const std::size_t before = pool.num_alive();
  EXPECT_EQ(cut_sides_off(pool).dropped, 0);
  EXPECT_EQ(pool.num_alive(), before);
}

}  // namespace
}  // namespace nda::reduce
