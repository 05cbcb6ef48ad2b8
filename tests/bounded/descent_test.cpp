#include "bounded/descent.hpp"

#include <gtest/gtest.h>

#include "bounded_parts.hpp"

namespace nda::bounded {
namespace {

TEST(Descent, ChoosesWithinTheBounds) {
  int best = 0;
  int parts = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    for (const BoundedComponent& part : random_parts(seed, 2 + static_cast<int>(seed % 4), 12)) {
      const Choice choice = greedy_descent(part, core::all_arcs(part.graph), {});
      std::uint64_t bits = 0;
      for (const core::ArcId a : choice.arcs) bits |= std::uint64_t{1} << a;
      EXPECT_NEAR(choice_of(part, bits).cost, choice.cost, 1e-9) << seed;
      EXPECT_LE(choice.cost, choice_of(part, 0).cost + 1e-9) << seed;
      ++parts;
      best += choice.cost <= least_cost(part) + 1e-9 ? 1 : 0;
    }
  }
  EXPECT_GT(best, parts / 2);
}

// Two arcs on one index that may be used once: the dearer one is thrown out.
TEST(Descent, Exchanges) {
  BoundedComponent part{core::make_component({1, 2}), {}};
  core::append_arc(part.graph, std::vector<Index>{1, 1}, -1);
  core::append_arc(part.graph, std::vector<Index>{1, 2}, -2);
  part.rows.resize(part.graph.num_slots());
  for (const std::uint32_t slot : {1u, 3u, 4u}) part.rows[slot] = {0, 0, 1, false, false};
  const std::vector<core::ArcId> worst_first = {0, 1};
  const Choice choice = greedy_descent(part, worst_first, {});
  EXPECT_EQ(choice.arcs, (std::vector<core::ArcId>{1}));
  EXPECT_EQ(choice.cost, -2);
}

}  // namespace
}  // namespace nda::bounded
