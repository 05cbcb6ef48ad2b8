#include "reduce/single_choice_arcs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/reduce_support.hpp"
#include "reduce/redundant_indices.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;

// Arc 0 is single on slot 1 once slot 4, which only it uses, is relieved.
core::Component with_single(double other) {
  return make({2, 2, 2}, {{{1, 1, 0}, -3}, {{1, 2, 1}, other}, {{2, 2, 2}, -4}});
}

TEST(SingleChoiceArcs, ChargeTheirIndex) {
  const core::Component component = with_single(-5);
  ArcPool pool;
  pool.reset(component);
  pool.relieve(4);
  const Transfers transfers = transfer_single_choices(pool);
  EXPECT_EQ(transfers.chosen, 1);
  EXPECT_EQ(transfers.dropped, 0);
  EXPECT_EQ(pool.charges()[1], -3);
  EXPECT_EQ(pool.cost(1), -2);
  EXPECT_THAT(pool.restore(component, {2}).arcs, ElementsAre(0, 2));
  EXPECT_THAT(pool.restore(component, {1}).arcs, ElementsAre(1));
}

TEST(SingleChoiceArcs, DropWhatCostsNoLess) {
  ArcPool pool;
  pool.reset(with_single(-3));
  pool.relieve(4);
  EXPECT_EQ(transfer_single_choices(pool).dropped, 1);
  EXPECT_THAT(arcs_alive(pool), ElementsAre(2));
}

TEST(SingleChoiceArcs, AreMissedByNoBestPackingAndNoMultipliers) {
  int dropped = 0;
  EXPECT_GT(times_equivalent([&](ArcPool& pool, std::uint64_t) {
              relieve_redundant_indices(pool);
              const Transfers transfers = transfer_single_choices(pool);
              dropped += transfers.dropped > 0;
              return transfers.chosen > 0;
            }),
            1000);
  EXPECT_GT(dropped, 300);
}

}  // namespace
}  // namespace nda::reduce
