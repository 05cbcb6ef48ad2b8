#include "reduce/redundant_indices.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/reduce_support.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;

TEST(RedundantIndices, AreThoseThatAnotherOneSpeaksFor) {
  // Index 1 of dimension 1 (slot 1) always comes with index 1 of dimension 2 (slot 4).
  ArcPool pool;
  pool.reset(make({2, 2, 2}, {{{1, 1, 1}, -1}, {{1, 1, 2}, -2}, {{2, 1, 1}, -3}, {{2, 2, 2}, -1}}));
  EXPECT_EQ(relieve_redundant_indices(pool), 3) << "slot 5 always comes with 2, 7 with 4";
  EXPECT_THAT(pool.slots(0), ElementsAre(4));
  EXPECT_THAT(pool.slots(1), ElementsAre(4, 8));
  EXPECT_THAT(pool.slots(2), ElementsAre(2, 4));
  EXPECT_THAT(pool.slots(3), ElementsAre(2, 8));
}

TEST(RedundantIndices, LeaveOneOfThoseWithTheSameArcs) {
  ArcPool pool;
  pool.reset(make({1, 1, 1}, {{{1, 1, 1}, -1}}));
  EXPECT_EQ(relieve_redundant_indices(pool), 2);
  EXPECT_THAT(pool.slots(0), ElementsAre(5));
  EXPECT_EQ(relieve_redundant_indices(pool), 0);
}

TEST(RedundantIndices, AreMissedByNoBestPackingAndNoMultipliers) {
  EXPECT_GT(times_equivalent(
                [](ArcPool& pool, std::uint64_t) { return relieve_redundant_indices(pool) > 0; }),
            1000);
}

// Without relieved indices the rest forbids all that the component forbids.
TEST(RedundantIndices, AllowNothingNew) {
  ArcPool pool;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const core::Component component = reducible_component(seed);
    pool.reset(component);
    relieve_redundant_indices(pool);
    for (core::ArcId a = 0; a < pool.num_arcs(); ++a) {
      for (core::ArcId b = a + 1; b < pool.num_arcs() && pool.alive(a); ++b) {
        if (!pool.alive(b)) continue;
        std::vector<std::uint32_t> before;
        core::for_each_slot(component, a, [&](std::uint32_t x) {
          core::for_each_slot(component, b, [&](std::uint32_t y) {
            if (x == y) before.push_back(x);
          });
        });
        std::vector<std::uint32_t> after;
        std::ranges::set_intersection(pool.slots(a), pool.slots(b), std::back_inserter(after));
        ASSERT_EQ(before.empty(), after.empty()) << "seed " << seed << " arcs " << a << " " << b;
      }
    }
  }
}

}  // namespace
}  // namespace nda::reduce
