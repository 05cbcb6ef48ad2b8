#include "decompose/reduced_cost_fixing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "relax/dual_function.hpp"
#include "support/components.hpp"

namespace nda::decompose {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kTie = 1e-9;

bool has(const std::vector<ArcId>& arcs, ArcId a) {
  return std::binary_search(arcs.begin(), arcs.end(), a);
}

bool share_an_index(const Component& component, ArcId a, ArcId b) {
  for (int k = 0; k < component.num_dimensions(); ++k) {
    if (component.index(k, a) != 0 && component.index(k, a) == component.index(k, b)) return true;
  }
  return false;
}

// Everything the header promises, for one component and all its packings.
void expect_sound(const Component& component,
                  const std::vector<Packing>& packings,
                  const Fixing& fixing,
                  double cutoff) {
  EXPECT_TRUE(std::is_sorted(fixing.live.begin(), fixing.live.end()));
  EXPECT_TRUE(std::is_sorted(fixing.taken.begin(), fixing.taken.end()));
  for (const ArcId a : fixing.taken) {
    for (const ArcId b : fixing.taken) EXPECT_TRUE(a == b || !share_an_index(component, a, b));
    for (const ArcId b : fixing.live) EXPECT_FALSE(share_an_index(component, a, b));
  }
  for (const Packing& packing : packings) {
    if (packing.cost >= cutoff - kTie) continue;
    for (const ArcId a : packing.arcs) EXPECT_TRUE(has(fixing.live, a) || has(fixing.taken, a));
    for (const ArcId a : fixing.taken) EXPECT_TRUE(has(packing.arcs, a));
  }
}

// The two rules, read from the header: what they drop and take must be gone.
void expect_rules_applied(const Component& component,
                          std::span<const double> u,
                          double lower,
                          const Fixing& fixing,
                          double cutoff) {
  const auto affordable = [&](ArcId a) {
    return lower + core::reduced_cost(component, u, a) < cutoff + kTie;
  };
  for (const ArcId a : fixing.live) EXPECT_TRUE(affordable(a));
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (!has(fixing.live, a)) continue;
    core::for_each_slot(component, a, [&](std::uint32_t slot) {
      bool only = lower - u[slot] >= cutoff + kTie;
      for (ArcId b = 0; b < component.num_arcs(); ++b) {
        bool on_slot = false;
        core::for_each_slot(component, b, [&](std::uint32_t s) { on_slot = on_slot || s == slot; });
        only = only && (b == a || !on_slot || !affordable(b));
      }
      EXPECT_FALSE(only) << "arc " << a << " is the only use of slot " << slot << ", yet not taken";
    });
  }
}

// (1,1) -5, (1,2) -3, (2,2) -4 with u = -2 -1 | -3 -3: r = 0, 2, 0; lower = -9, the optimum.
Component square() {
  Component component = core::make_component({2, 2});
  core::append_arc(component, std::vector<Index>{1, 1}, -5);
  core::append_arc(component, std::vector<Index>{1, 2}, -3);
  core::append_arc(component, std::vector<Index>{2, 2}, -4);
  return component;
}
const std::vector<double> kSquareMultipliers = {0, -2, -1, 0, -3, -3};

TEST(Fixing, DropsArcsThatAreTooDear) {
  // (1,1) -1, (1,2) 2, (2,2) -1 with u = -1/2 everywhere: r = 0, 3, 0; leaving an index costs 1/2.
  Component component = core::make_component({2, 2});
  core::append_arc(component, std::vector<Index>{1, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 2}, 2);
  core::append_arc(component, std::vector<Index>{2, 2}, -1);
  const Fixing fixing = fix(component, std::vector<double>{0, -0.5, -0.5, 0, -0.5, -0.5}, -2, 1);
  EXPECT_THAT(fixing.taken, IsEmpty());
  EXPECT_THAT(fixing.live, ElementsAre(0, 2)) << "-2 + 3 is not below 1";
}

TEST(Fixing, KeepsEverythingBelowAGenerousCutoff) {
  const Fixing fixing = fix(square(), kSquareMultipliers, -9, 0);
  EXPECT_THAT(fixing.taken, IsEmpty());
  EXPECT_THAT(fixing.live, ElementsAre(0, 1, 2));
}

TEST(Fixing, TakesTheOnlyUseLeft) {
  const Fixing fixing = fix(square(), kSquareMultipliers, -9, -8.5);
  EXPECT_THAT(fixing.taken, ElementsAre(0, 2));
  EXPECT_THAT(fixing.live, IsEmpty());
}

TEST(Fixing, DropsEverythingWhenNothingCanBeCheaper) {
  const Fixing fixing = fix(square(), kSquareMultipliers, -9, -9);
  EXPECT_THAT(fixing.taken, IsEmpty());
  EXPECT_THAT(fixing.live, IsEmpty());
}

TEST(Fixing, DropsTheRivalsOfATakenArc) {
  // Index 1 of dimension 1 knows (1,1) only, leaving it costs 10: (1,1) is taken, so (2,1) is
  // dropped though its reduced cost is 0.
  Component component = core::make_component({2, 1});
  core::append_arc(component, std::vector<Index>{1, 1}, -10);
  core::append_arc(component, std::vector<Index>{2, 1}, -1);
  const Fixing fixing = fix(component, std::vector<double>{0, -10, -1, 0, 0}, -11, -5);
  EXPECT_THAT(fixing.taken, ElementsAre(0));
  EXPECT_THAT(fixing.live, IsEmpty());
}

TEST(Fixing, NeverRemovesAPackingCheaperThanTheCutoff) {
  int num_taken = 0;
  int num_dropped = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    Component component = support::random_component_of_any_kind(seed);
    if (component.num_arcs() > 14) continue;
    std::vector<double> u =
        support::feasible_multipliers(component, random, random.below(2) == 0 ? 0.0 : 2.0);
    if (random.below(2) == 0) {
      for (int sweep = 0; sweep < 3; ++sweep) relax::make_feasible(component, u);
    }
    const double lower = support::sum_of(u);
    const std::vector<Packing> packings = support::all_packings(component);
    double best = 0;
    for (const Packing& packing : packings) best = std::min(best, packing.cost);
    for (const double cutoff :
         {best + 1e-6, best, best + random.uniform(0, 4), random.uniform(best, 0), 1.0, 1e9}) {
      SCOPED_TRACE(cutoff);
      const Fixing fixing = fix(component, u, lower, cutoff);
      expect_sound(component, packings, fixing, cutoff);
      if (cutoff > best + kTie) expect_rules_applied(component, u, lower, fixing, cutoff);
      num_taken += !fixing.taken.empty() && cutoff > best;
      num_dropped += fixing.live.size() + fixing.taken.size() < component.num_arcs();
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(num_taken, 500);
  EXPECT_GT(num_dropped, 500);
}

}  // namespace
}  // namespace nda::decompose
