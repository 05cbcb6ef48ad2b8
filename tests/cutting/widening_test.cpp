#include "cutting/widening.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::Component;
using core::Packing;

struct Outcome {
  WideningResult result;
  Packing best;
  double last_bound = -kInfinity;
};

// Circles offer packings of what they were cut to.
double cost_in(const Component& whole, const Master& point, const Packing& packing) {
  double cost = 0;
  for (const core::ArcId a : packing.arcs)
    cost += whole.costs[core::original_arc(point.component(), a)];
  return cost;
}

Outcome search(const Component& component,
               double cutoff,
               std::int64_t max_nodes,
               const std::vector<Cut>& cuts = {}) {
  Outcome outcome;
  outcome.best.cost = cutoff;
  WideningLimits limits;
  limits.cutoff = cutoff;
  limits.max_nodes = max_nodes;
  limits.cuts = cuts;
  if (!cuts.empty()) limits.lower_without_cuts = -100;
  WideningObserver observer;
  observer.offer = [&](const Master& point, const Packing* packing) {
    if (packing != nullptr && packing->cost < outcome.best.cost) outcome.best = *packing;
    if (packing != nullptr) {
      EXPECT_NEAR(cost_in(component, point, *packing), packing->cost, 1e-9);
    }
    return outcome.best.cost - 1e-7;
  };
  observer.relaxed = [&](const Master& point) { EXPECT_EQ(point.cuts().size(), cuts.size()); };
  observer.improve = [&](const Master&, const PrimalBudget&) { return outcome.best.cost - 1e-7; };
  observer.raise = [&](double lower) {
    EXPECT_GT(lower, outcome.last_bound);
    outcome.last_bound = lower;
  };
  outcome.result = search_widening(component, no_multipliers(component), limits, observer);
  return outcome;
}

// The arcs of all packings cheaper than that.
std::size_t num_arcs_below(const Component& component, double cutoff) {
  std::vector<bool> used(component.num_arcs(), false);
  for (const Packing& packing : support::all_packings(component)) {
    if (packing.cost >= cutoff) continue;
    for (const core::ArcId a : packing.arcs) used[a] = true;
  }
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

// From no solution at all, so that every circle but the last is empty.
TEST(Widening, FindsTheOptimumAndProvesIt) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const Component component =
        seed % 2 == 0 ? fractional_component(seed) : support::random_component_of_any_kind(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, 1e-6, 1000000);
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_NEAR(std::min(0.0, outcome.best.cost), best, 1e-6) << "seed " << seed;
    ASSERT_LE(outcome.last_bound, best + 1e-6) << "seed " << seed;
  }
}

TEST(Widening, TakesCutsToBeginWith) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    std::vector<std::uint32_t> slots;
    core::for_each_index(component,
                         [&](std::uint32_t slot, std::size_t, Index) { slots.push_back(slot); });
    core::Random random(seed);
    std::vector<Cut> cuts;
    while (cuts.size() < 30) {
      core::shuffle(slots, random);
      std::vector<std::uint32_t> three(slots.begin(), slots.begin() + 3);
      std::sort(three.begin(), three.end());
      cuts.push_back({three, {1, 1, 1}, 2});
    }
    const Outcome outcome = search(component, 1e-6, 1000000, cuts);
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_NEAR(std::min(0.0, outcome.best.cost), support::best_cost(component), 1e-6) << seed;
  }
}

TEST(Widening, ItsBoundHoldsWhereverItStops) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Component component = fractional_component(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, 1e-6, static_cast<std::int64_t>(seed % 4));
    ASSERT_LE(outcome.result.lower, best + 1e-6) << "seed " << seed;
  }
}

TEST(Widening, SaysHowManyArcsReducedCostsLeft) {
  std::size_t dropped = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    const double cutoff = support::best_cost(component) + 0.3;
    const Outcome outcome = search(component, cutoff, static_cast<std::int64_t>(seed % 3));
    const std::size_t live = outcome.result.live_arcs;
    EXPECT_LE(live, component.num_arcs());
    EXPECT_GE(live, num_arcs_below(component, outcome.best.cost - 1e-6));
    dropped += component.num_arcs() - live;
  }
  EXPECT_GT(dropped, 100);
}

}  // namespace
}  // namespace nda::cutting
