#include "cutting/cut.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;

Cut random_cut(const Component& component, core::Random& random) {
  Cut cut;
  cut.divisor = static_cast<std::uint8_t>(2 + random.below(5));
  for (std::uint32_t slot = 0; slot < component.num_slots(); ++slot) {
    if (component.origin[slot] == 0 || random.uniform() < 0.4) continue;
    cut.slots.push_back(slot);
    cut.weights.push_back(static_cast<std::uint8_t>(1 + random.below(cut.divisor - 1u)));
  }
  return cut;
}

// The coefficient by its definition.
int coefficient(const Component& component, const Cut& cut, ArcId a) {
  int weight = 0;
  core::for_each_slot(component, a, [&](std::uint32_t slot) {
    const auto place = std::find(cut.slots.begin(), cut.slots.end(), slot);
    if (place != cut.slots.end()) weight += cut.weights[place - cut.slots.begin()];
  });
  return weight / cut.divisor;
}

TEST(Cut, CliqueOfThreeIndices) {
  const Component component = triangle();
  const Cut cut = {{1, 3, 5}, {1, 1, 1}, 2};
  EXPECT_EQ(cut.right_side(), 1);
  CutLister lister(component.num_arcs());
  const SlotIndex index(component, all_arcs(component));
  EXPECT_EQ(lister.list(cut, index).size(), 3u);
}

TEST(Cut, ListsEveryArcWithItsCoefficient) {
  core::Random random(1);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    const SlotIndex index(component, all_arcs(component));
    CutLister lister(component.num_arcs());
    for (int draw = 0; draw < 5; ++draw) {
      const Cut cut = random_cut(component, random);
      std::vector<int> listed(component.num_arcs(), 0);
      for (const CutEntry& entry : lister.list(cut, index)) listed[entry.arc] = entry.coefficient;
      for (ArcId a = 0; a < component.num_arcs(); ++a) {
        ASSERT_EQ(listed[a], coefficient(component, cut, a)) << "seed " << seed << " arc " << a;
      }
    }
  }
}

TEST(Cut, HoldsForEveryPacking) {
  core::Random random(2);
  int tight = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Component component = fractional_component(seed);
    const std::vector<core::Packing> packings = support::all_packings(component);
    for (int draw = 0; draw < 5; ++draw) {
      const Cut cut = random_cut(component, random);
      for (const core::Packing& packing : packings) {
        int left = 0;
        for (const ArcId a : packing.arcs) left += coefficient(component, cut, a);
        ASSERT_LE(left, cut.right_side()) << "seed " << seed;
        tight += left == cut.right_side() && left > 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(tight, 1000);
}

}  // namespace
}  // namespace nda::cutting
