#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "reduce/arc_pool.hpp"
#include "support/components.hpp"

namespace nda::reduce {

/// An arc of N indices and its cost.
struct GivenArc {
  std::vector<Index> tuple;
  double cost;
};

inline core::Component make(std::vector<Index> sizes, std::initializer_list<GivenArc> arcs) {
  core::Component component = core::make_component(std::move(sizes));
  for (const GivenArc& arc : arcs) core::append_arc(component, arc.tuple, arc.cost);
  return component;
}

/// The arcs alive, with the indices they show.
inline std::vector<core::ArcId> arcs_alive(const ArcPool& pool) {
  std::vector<core::ArcId> arcs;
  for (core::ArcId a = 0; a < pool.num_arcs(); ++a) {
    if (pool.alive(a)) arcs.push_back(a);
  }
  return arcs;
}

inline core::Component rest_of(const ArcPool& pool, const core::Component& component) {
  core::Component rest = core::make_component(component.sizes);
  for (const core::ArcId a : arcs_alive(pool)) {
    std::vector<Index> tuple(component.sizes.size(), 0);
    for (const std::uint32_t slot : pool.slots(a)) {
      std::size_t k = component.sizes.size() - 1;
      while (component.offset[k] > slot) --k;
      tuple[k] = slot - component.offset[k];
    }
    core::append_arc(rest, tuple, pool.cost(a));
  }
  return rest;
}

/// What is left is as good as the component: the best packing of the rest becomes a best packing,
/// and multipliers of the rest become multipliers that prove as much.
inline void expect_equivalent(const core::Component& component,
                              const ArcPool& pool,
                              std::uint64_t seed) {
  const core::Component rest = rest_of(pool, component);
  const std::vector<core::ArcId> alive = arcs_alive(pool);
  const std::vector<core::Packing> packings = support::all_packings(rest);
  const auto best = std::min_element(
      packings.begin(), packings.end(), [](auto& x, auto& y) { return x.cost < y.cost; });
  std::vector<core::ArcId> arcs;
  for (const core::ArcId a : best->arcs) arcs.push_back(alive[a]);
  const core::Packing restored = pool.restore(component, arcs);
  const double charged = support::sum_of(pool.charges());
  EXPECT_EQ(support::packing_fault(component, restored), "");
  EXPECT_NEAR(restored.cost, support::best_cost(component), 1e-9);
  EXPECT_NEAR(restored.cost, best->cost + charged, 1e-9);

  core::Random random(seed);
  std::vector<double> u = support::feasible_multipliers(rest, random, random.uniform());
  for (std::size_t slot = 0; slot < u.size(); ++slot) u[slot] += pool.charges()[slot];
  EXPECT_EQ(support::multiplier_fault(component, u), "");
}

/// Components on which every rule finds something now and then: few arcs on few or many indices.
inline core::Component reducible_component(std::uint64_t seed) {
  if (seed % 2 == 0) return support::random_component_of_any_kind(seed);
  core::Random random(seed);
  support::RandomComponentOptions options;
  options.sizes.assign(3 + random.below(3), 1 + static_cast<Index>(random.below(6)));
  options.num_arcs = 2 + static_cast<int>(random.below(12));
  options.dummy_share = 0.5;
  options.integer = random.below(2) == 0;
  return support::random_component(seed, options);
}

/// Applies a rule to thousands of components; returns how often it did something.
template <typename Rule>
int times_equivalent(Rule&& rule) {
  int times = 0;
  ArcPool pool;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    const core::Component component = reducible_component(seed);
    pool.reset(component);
    if (rule(pool, seed)) ++times;
    expect_equivalent(component, pool, seed);
    if (::testing::Test::HasFailure()) return times;
  }
  return times;
}

}  // namespace nda::reduce
