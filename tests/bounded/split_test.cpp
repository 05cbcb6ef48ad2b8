#include "bounded/split.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nda::bounded {
namespace {

// Index 1 of dimension 1 must be used twice, and one arc has it.
TEST(Split, SaysWhichIndexHasTooFewArcs) {
  ProblemBuilder builder({2, 2});
  builder.add_arc({1, 0}, kInfinity);
  builder.add_arc({1, 1}, 4.0);
  builder.set_use_bounds(0, 1, {2, 3});
  const Split parts = split(std::move(builder).build(), {});
  EXPECT_EQ(parts.infeasible, "index 1 of dimension 1 must be used 2 times, and 1 arc contains it");
}

// Bounds of 0..inf ask nothing: both arcs of negative cost are taken, the third costs.
TEST(Split, TakesWhatCouplesNothing) {
  ProblemBuilder builder({1, 3});
  for (Index j = 1; j <= 3; ++j) {
    builder.add_arc({1, j}, static_cast<double>(j) - 2.5);
    builder.set_use_bounds(1, j, {0, 5});
  }
  builder.set_use_bounds(0, 1, {0, UseBounds::kUnlimited});
  const Split parts = split(std::move(builder).build(), {});
  EXPECT_EQ(parts.taken, (std::vector<core::ArcId>{0, 1}));
  EXPECT_EQ(parts.taken_cost, (std::vector<double>{-1.5, -0.5}));
  EXPECT_TRUE(parts.parts.empty());
  EXPECT_EQ(parts.rest->num_arcs(), 0u);
}

// Index 1 of dimension 1 may be used twice and has two arcs: they are the ways to leave the others
// alone, whose own singletons cost 1.
TEST(Split, MakesArcsSingletons) {
  ProblemBuilder builder({1, 2});
  builder.add_arc({0, 1}, 1.0);
  builder.add_arc({0, 2}, 1.0);
  builder.add_arc({1, 1}, -3.0);
  builder.add_arc({1, 2}, 0.5);
  builder.set_use_bounds(0, 1, {0, 2});
  const Split parts = split(std::move(builder).build(), {});
  EXPECT_TRUE(parts.parts.empty());
  EXPECT_EQ(parts.rest->singleton_costs(1)[1], -3.0);
  EXPECT_EQ(parts.rest->singleton_costs(1)[2], 0.5);
  EXPECT_EQ(parts.alone[1][1], 0u);
  EXPECT_EQ(parts.alone[1][2], 1u);
}

// Two stars that share nothing: one has bounds that bind, the other one is ordinary.
TEST(Split, SeparatesWhatHasBounds) {
  ProblemBuilder builder({2, 5});
  for (Index j = 1; j <= 3; ++j) builder.add_arc({1, j}, -1.0);
  builder.add_arc({2, 4}, -1.0);
  builder.add_arc({2, 5}, -2.0);
  builder.set_use_bounds(0, 1, {0, 2});
  const Split parts = split(std::move(builder).build(), {});
  ASSERT_EQ(parts.parts.size(), 1u);
  EXPECT_EQ(parts.parts.front().num_arcs(), 3u);
  EXPECT_EQ(parts.rest->num_arcs(), 2u);
  EXPECT_EQ(parts.rest_arc, (std::vector<core::ArcId>{3, 4}));
  EXPECT_EQ(parts.in_rest[0][1], 0);
  EXPECT_EQ(parts.in_rest[0][2], 1);
}

}  // namespace
}  // namespace nda::bounded
