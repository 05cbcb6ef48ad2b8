#include "recovery/neighbourhood_search.hpp"

#include <gtest/gtest.h>

#include "recovery/greedy.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;
using core::Random;
using support::large_component;
using support::packing_fault;

constexpr double kTie = 1e-9;

Packing search(const Component& component,
               Packing packing,
               double work,
               double goal = -kInfinity,
               std::uint64_t seed = 1) {
  Random multipliers(seed);
  const std::vector<double> u = support::feasible_multipliers(component, multipliers);
  Random random(seed);
  NeighbourhoodSearch(component, u).improve(packing, work, goal, random, {});
  return packing;
}

TEST(NeighbourhoodSearch, NeverMakesAPackingWorse) {
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const Packing start = greedy(component, component.costs);
    const Packing found = search(component, start, 1e5, -kInfinity, seed);
    ASSERT_EQ(packing_fault(component, found), "");
    ASSERT_LE(found.cost, start.cost);
    ASSERT_GE(found.cost, support::best_cost(component) - kTie);
    num_better += found.cost < start.cost - kTie;
  }
  EXPECT_GT(num_better, 50);
}

TEST(NeighbourhoodSearch, FindsTheOptimumOfSmallComponentsFromNothing) {
  int num_missed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = support::random_component_of_any_kind(seed);
    const double best = std::min(0.0, support::best_cost(component));
    num_missed += search(component, {}, 2e6, best, seed).cost > best + kTie;
  }
  EXPECT_LT(num_missed, 10);
}

TEST(NeighbourhoodSearch, StopsAtTheGoal) {
  const Component component = large_component(3);
  const Packing best = search(component, {}, 2e7);
  const double goal = best.cost / 2;
  const Packing found = search(component, {}, 2e7, goal);
  EXPECT_LE(found.cost, goal);
  EXPECT_GT(found.cost, best.cost) << "one step does not lead from the goal to the optimum";
}

TEST(NeighbourhoodSearch, IsDeterministic) {
  const Component component = large_component(4);
  EXPECT_EQ(search(component, {}, 1e6).arcs, search(component, {}, 1e6).arcs);
}

TEST(NeighbourhoodSearch, StopsAtTheDeadline) {
  const Component component = large_component(5);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  Packing packing;
  const core::Stopwatch watch;
  NeighbourhoodSearch(component, u)
      .improve(packing, kInfinity, -kInfinity, random, core::Deadline(0.02));
  EXPECT_LT(watch.seconds(), 5);
  EXPECT_EQ(packing_fault(component, packing), "");
}

TEST(NeighbourhoodSearch, HasNothingToDoWithoutArcs) {
  const Component none = core::make_component({2, 2});
  EXPECT_EQ(search(none, {}, 1e6).cost, 0);
}

}  // namespace
}  // namespace nda::recovery
