#include "reduce/reducer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/cut_indices.hpp"
#include "reduce/dominated_arcs.hpp"
#include "reduce/outweighing_arcs.hpp"
#include "reduce/reduce_support.hpp"
#include "reduce/redundant_indices.hpp"
#include "reduce/single_choice_arcs.hpp"

namespace nda::reduce {
namespace {

void apply(int rule, ArcPool& pool) {
  if (rule == 0) drop_dominated_arcs(pool);
  if (rule == 1) relieve_redundant_indices(pool);
  if (rule == 2) transfer_single_choices(pool);
  if (rule == 3) take_outweighing_arcs(pool);
  if (rule == 4) cut_sides_off(pool);
}

TEST(Reducer, RulesMayComeInAnyOrder) {
  EXPECT_GT(times_equivalent([](ArcPool& pool, std::uint64_t seed) {
              core::Random random(seed);
              const std::size_t before = pool.num_alive();
              for (int n = 0; n < 12; ++n) apply(static_cast<int>(random.below(5)), pool);
              return pool.num_alive() < before;
            }),
            2000);
}

TEST(Reducer, CountsWhatEveryRuleDid) {
  Reducer reducer;
  ReductionYield total;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const core::Component component = reducible_component(seed);
    reducer.reduce(component, Effort::kAll);
    const ReductionYield& yield = reducer.yield();
    std::size_t paying = 0;
    for (const double cost : component.costs) paying += cost < 0;
    EXPECT_EQ(yield.components, 1);
    EXPECT_EQ(yield.arcs, component.num_arcs());
    EXPECT_EQ(yield.left, arcs_alive(reducer.pool()).size());
    EXPECT_EQ(yield.dominated + yield.outweighing + yield.excluded + yield.single +
                  yield.unprofitable + yield.side_arcs + yield.left,
              paying);
    expect_equivalent(component, reducer.pool(), seed);
    total += yield;
  }
  EXPECT_EQ(total.components, 500);
  EXPECT_GT(std::min({total.dominated,
                      total.redundant,
                      total.outweighing,
                      total.excluded,
                      total.single,
                      total.unprofitable,
                      total.sides,
                      total.left}),
            20);
}

TEST(Reducer, SettlesWithTheOptimumAndACertificate) {
  Reducer reducer;
  int settled = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    const core::Component component = reducible_component(seed);
    const std::optional<Settled> result =
        reducer.settle(component, seed % 3 == 0 ? Effort::kQuick : Effort::kAll);
    if (!result) continue;
    ++settled;
    EXPECT_EQ(support::packing_fault(component, result->best), "");
    EXPECT_NEAR(result->best.cost, support::best_cost(component), 1e-9);
    EXPECT_EQ(support::multiplier_fault(component, result->u), "");
    EXPECT_NEAR(result->certificate, result->best.cost, 1e-9);
    EXPECT_LE(result->certificate, support::sum_of(result->u));
    if (HasFailure()) return;
  }
  EXPECT_GT(settled, 2000);
}

TEST(Reducer, SettlesWhatHasNoArcs) {
  Reducer reducer;
  for (const Effort effort : {Effort::kQuick, Effort::kAll}) {
    const std::optional<Settled> result = reducer.settle(make({2, 1}, {}), effort);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->best.cost, 0);
    EXPECT_EQ(result->certificate, 0);
    EXPECT_EQ(result->u, std::vector<double>(5, 0.0));
  }
}

TEST(Reducer, SettlesNothingWhereTheRelaxationHasAGap) {
  const core::Component triangle =
      make({1, 1, 1}, {{{0, 1, 1}, -2}, {{1, 0, 1}, -2}, {{1, 1, 0}, -2}});
  Reducer reducer;
  EXPECT_FALSE(reducer.settle(triangle, Effort::kAll).has_value());
  EXPECT_EQ(reducer.yield().left, 3);
  EXPECT_FALSE(reducer.settle(triangle, Effort::kQuick).has_value());
  EXPECT_EQ(reducer.yield().components, 0) << "its cheapest arc does not outweigh the others";
}

}  // namespace
}  // namespace nda::reduce
