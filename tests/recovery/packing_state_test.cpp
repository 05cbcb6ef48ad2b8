#include "recovery/packing_state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

TEST(SlotArcs, ListTheArcsOfEverySlotCheapestFirst) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const SlotArcs slot_arcs(component, component.costs);
    std::vector<std::vector<ArcId>> expected(component.num_slots());
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      core::for_each_slot(component, a, [&](std::uint32_t s) { expected[s].push_back(a); });
    }
    for (std::uint32_t slot = 0; slot < expected.size(); ++slot) {
      std::stable_sort(expected[slot].begin(), expected[slot].end(), [&](ArcId a, ArcId b) {
        return component.costs[a] < component.costs[b];
      });
      EXPECT_THAT(slot_arcs[slot], ElementsAreArray(expected[slot]));
    }
    for (const std::uint32_t dummy : component.offset) EXPECT_THAT(slot_arcs[dummy], IsEmpty());
  }
}

// The same packing as a plain set of arcs.
struct Model {
  const Component& component;
  std::set<ArcId> in;

  bool share(ArcId a, ArcId b) const {
    for (int k = 0; k < component.num_dimensions(); ++k) {
      if (component.index(k, a) != 0 && component.index(k, a) == component.index(k, b)) return true;
    }
    return false;
  }

  std::vector<ArcId> conflicts(ArcId a) const {
    std::vector<ArcId> found;
    for (const ArcId b : in) {
      if (b != a && share(a, b)) found.push_back(b);
    }
    return found;
  }

  double cost(const std::vector<ArcId>& arcs) const {
    double sum = 0;
    for (const ArcId a : arcs) sum += component.costs[a];
    return sum;
  }

  std::vector<ArcId> arcs() const { return {in.begin(), in.end()}; }
};

void expect_equal(const PackingState& state, const Model& model) {
  const Component& component = model.component;
  EXPECT_NEAR(state.cost(), model.cost(model.arcs()), 1e-9);
  const Packing packing = state.packing();
  EXPECT_EQ(packing.arcs, model.arcs());
  EXPECT_EQ(packing.cost, model.cost(model.arcs())) << "summed afresh, in ascending order";
  std::vector<ArcId> owner(component.num_slots(), kNoArc);
  for (const ArcId a : model.in) {
    core::for_each_slot(component, a, [&](std::uint32_t s) { owner[s] = a; });
  }
  for (std::uint32_t slot = 0; slot < owner.size(); ++slot) {
    EXPECT_EQ(state.owner(slot), owner[slot]);
  }
  std::vector<ArcId> found = {12345};
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const std::vector<ArcId> expected = model.conflicts(a);
    EXPECT_EQ(state.contains(a), model.in.count(a) == 1);
    EXPECT_EQ(state.fits(a), expected.empty() && model.in.count(a) == 0);
    EXPECT_NEAR(state.conflicts(a, found), model.cost(expected), 1e-9);
    EXPECT_THAT(found, UnorderedElementsAreArray(expected));
  }
}

TEST(PackingState, KeepsItsBooksThroughRandomMoves) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    core::Random random(seed);
    PackingState state(component);
    Model model{component, {}};
    expect_equal(state, model);
    for (int move = 0; move < 40; ++move) {
      const ArcId a = static_cast<ArcId>(random.below(component.num_arcs()));
      if (model.in.count(a) == 1) {
        state.remove(a);
        model.in.erase(a);
      } else {
        for (const ArcId b : model.conflicts(a)) {
          state.remove(b);
          model.in.erase(b);
        }
        state.insert(a);
        model.in.insert(a);
      }
      expect_equal(state, model);
    }
    if (HasFailure()) return;
  }
}

TEST(PackingState, AssignReplacesWhatWasThere) {
  const Component component = support::random_component(2);
  PackingState state(component);
  for (const Packing& packing : support::all_packings(component)) {
    state.assign(packing);
    EXPECT_EQ(state.packing().arcs, packing.arcs);
    EXPECT_NEAR(state.cost(), packing.cost, 1e-9);
  }
  state.assign({});
  EXPECT_EQ(state.cost(), 0);
  EXPECT_THAT(state.packing().arcs, IsEmpty());
}

}  // namespace
}  // namespace nda::recovery
