#include "recovery/combine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;
using ::testing::ElementsAre;

// (1,1) -5, (1,2) -4, (2,1) -4, (3,3) -1, (3,4) -2: the first two clusters know nothing of the
// last.
TEST(Combine, TakesTheBetterOfEveryCluster) {
  Component component = core::make_component({3, 4});
  core::append_arc(component, std::vector<Index>{1, 1}, -5);
  core::append_arc(component, std::vector<Index>{1, 2}, -4);
  core::append_arc(component, std::vector<Index>{2, 1}, -4);
  core::append_arc(component, std::vector<Index>{3, 3}, -1);
  core::append_arc(component, std::vector<Index>{3, 4}, -2);
  const Packing packing = combine(component, {{0, 4}, -7}, {{1, 2, 3}, -9});
  EXPECT_THAT(packing.arcs, ElementsAre(1, 2, 4));
  EXPECT_EQ(packing.cost, -10);
}

TEST(Combine, IsAPackingNoDearerThanEither) {
  int num_better = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    if (component.num_arcs() > 14) continue;
    const std::vector<Packing> packings = support::all_packings(component);
    core::Random random(seed);
    const Packing& first = packings[random.below(packings.size())];
    const Packing& second = packings[random.below(packings.size())];
    const Packing packing = combine(component, first, second);
    EXPECT_EQ(support::packing_fault(component, packing), "");
    EXPECT_LE(packing.cost, std::min(first.cost, second.cost) + 1e-9);
    num_better += packing.cost < std::min(first.cost, second.cost) - 1e-9;
  }
  EXPECT_GT(num_better, 100);
}

}  // namespace
}  // namespace nda::recovery
