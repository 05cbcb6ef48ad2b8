#include "decompose/exchange_fixing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/reduced_costs.hpp"
#include "support/components.hpp"

namespace nda::decompose {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> reduced_costs(const Component& component, std::span<const double> u) {
  std::vector<double> reduced(component.num_arcs());
  core::reduced_costs(component, u, 0, reduced);
  return reduced;
}

// Two squares side by side, (1,1) -5, (1,2) -4, (2,1) -4, (2,2) -1 each.  The best of each costs
// -8, by its second and third arc, as u = -4 -1 | -3 0 proves, with r = 2, 0, 0, 0; greedy finds
// -6.
Component two_squares() {
  Component component = core::make_component({4, 4});
  for (const Index corner : {0u, 2u}) {
    core::append_arc(component, std::vector<Index>{corner + 1, corner + 1}, -5);
    core::append_arc(component, std::vector<Index>{corner + 1, corner + 2}, -4);
    core::append_arc(component, std::vector<Index>{corner + 2, corner + 1}, -4);
    core::append_arc(component, std::vector<Index>{corner + 2, corner + 2}, -1);
  }
  return component;
}

TEST(ExchangeFixing, SettlesWhereNothingIsLost) {
  const Component component = two_squares();
  const std::vector<double> u = {0, -4, -1, -4, -1, 0, -3, 0, -3, 0};
  const ExchangeFixing fixing =
      fix_by_exchange(component, u, reduced_costs(component, u), {{1, 2, 5, 6}, -16}, 0);
  EXPECT_THAT(fixing.open, IsEmpty());
  EXPECT_THAT(fixing.settled, ElementsAre(1, 2, 5, 6));
}

// The first square has the greedy packing, its rivals are open.  The second is settled, though the
// gap of the whole, 2, exceeds the reduced cost 0 of its last arc.
TEST(ExchangeFixing, IsLocal) {
  const Component component = two_squares();
  const std::vector<double> u = {0, -4, -1, -4, -1, 0, -3, 0, -3, 0};
  const ExchangeFixing fixing =
      fix_by_exchange(component, u, reduced_costs(component, u), {{0, 3, 5, 6}, -14}, 0);
  EXPECT_THAT(fixing.open, ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(fixing.settled, ElementsAre(5, 6));
}

TEST(ExchangeFixing, LeavesTheEmptyPackingOpen) {
  const Component component = two_squares();
  const std::vector<double> u = {0, -4, -1, -4, -1, 0, -3, 0, -3, 0};
  const ExchangeFixing fixing = fix_by_exchange(component, u, reduced_costs(component, u), {}, 0);
  EXPECT_EQ(fixing.open.size(), 8u);
  EXPECT_THAT(fixing.settled, IsEmpty());
}

// Some packing of least cost consists of all settled arcs and some that are open.
TEST(ExchangeFixing, LeavesAPackingOfLeastCost) {
  std::size_t num_settled = 0;
  std::size_t num_excluded = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    if (component.num_arcs() > 14) continue;
    const std::vector<double> u =
        support::feasible_multipliers(component, random, random.below(2) == 0 ? 0.0 : 2.0);
    const std::vector<Packing> packings = support::all_packings(component);
    double least = 0;
    for (const Packing& packing : packings) least = std::min(least, packing.cost);
    Packing best = packings[random.below(packings.size())];
    for (int n = 0; n < 10; ++n) {
      const Packing& other = packings[random.below(packings.size())];
      if (other.cost < best.cost) best = other;
    }
    std::erase_if(best.arcs, [&](ArcId a) { return component.costs[a] >= 0; });
    best = core::make_packing(component, std::move(best.arcs));
    const ExchangeFixing fixing =
        fix_by_exchange(component, u, reduced_costs(component, u), best, 0);
    double left = kInfinity;
    for (const Packing& packing : packings) {
      const auto is_in = [](const std::vector<ArcId>& arcs) {
        return [&](ArcId a) { return std::binary_search(arcs.begin(), arcs.end(), a); };
      };
      const bool keeps =
          std::all_of(fixing.settled.begin(), fixing.settled.end(), is_in(packing.arcs));
      const bool is_left = std::all_of(packing.arcs.begin(), packing.arcs.end(), [&](ArcId a) {
        return is_in(fixing.open)(a) || is_in(fixing.settled)(a);
      });
      if (keeps && is_left) left = std::min(left, packing.cost);
    }
    EXPECT_NEAR(left, least, 1e-9);
    num_settled += fixing.settled.size();
    num_excluded += component.num_arcs() - fixing.open.size() - fixing.settled.size();
  }
  EXPECT_GT(num_settled, 500u);
  EXPECT_GT(num_excluded, 500u);
}

}  // namespace
}  // namespace nda::decompose
