#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "recovery/core_search.hpp"
#include "recovery/greedy.hpp"
#include "recovery/local_search.hpp"
#include "support/components.hpp"
#include "support/tiny_problems.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using core::Random;
using support::large_component;
using support::packing_fault;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::IsEmpty;

constexpr double kTie = 1e-9;

bool share_an_index(const Component& component, ArcId a, ArcId b) {
  for (int k = 0; k < component.num_dimensions(); ++k) {
    if (component.index(k, a) != 0 && component.index(k, a) == component.index(k, b)) return true;
  }
  return false;
}

std::vector<ArcId> naive_greedy(const Component& component, const std::vector<double>& key) {
  std::vector<ArcId> order(component.num_arcs());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](ArcId a, ArcId b) { return key[a] < key[b]; });
  std::vector<ArcId> taken;
  for (const ArcId a : order) {
    const bool fits = std::none_of(
        taken.begin(), taken.end(), [&](ArcId b) { return share_an_index(component, a, b); });
    if (fits && component.costs[a] < 0) taken.push_back(a);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::vector<double> reduced_costs(const Component& component, std::span<const double> u) {
  std::vector<double> reduced;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    reduced.push_back(core::reduced_cost(component, u, a));
  }
  return reduced;
}

TEST(Greedy, TakesArcsInTheOrderOfTheKey) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    Random random(seed);
    std::vector<double> key = component.costs;
    if (seed % 2 == 0) {
      for (double& value : key) value = static_cast<double>(random.below(4));  // ties
    }
    const Packing packing = greedy(component, key);
    EXPECT_EQ(packing_fault(component, packing), "");
    EXPECT_EQ(packing.arcs, naive_greedy(component, key));
  }
}

TEST(Greedy, ByCostIsFooledByCrossingTracks) {
  const Component component = support::whole_component(support::crossing_tracks().problem);
  EXPECT_EQ(greedy(component, component.costs).cost, -7);
}

TEST(DualGreedy, RanksByReducedCost) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random, 4);
    const std::vector<double> key = reduced_costs(component, u);
    const Packing packing = dual_greedy(component, u);
    EXPECT_EQ(packing_fault(component, packing), "");
    std::vector<double> sorted = key;
    std::sort(sorted.begin(), sorted.end());
    bool distinct = true;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      distinct = distinct && sorted[i] - sorted[i - 1] > 1e-3;
    }
    if (!distinct) continue;
    EXPECT_EQ(packing.arcs, naive_greedy(component, key));
    ++num_compared;
  }
  EXPECT_GT(num_compared, 200);
}

TEST(DualGreedy, TakesTheCheaperOfEquallyReducedArcs) {
  Component component = core::make_component({1, 2});
  core::append_arc(component, std::vector<Index>{1, 1}, -3);
  core::append_arc(component, std::vector<Index>{1, 2}, -5);
  EXPECT_THAT(dual_greedy(component, std::vector<double>{0, -3, 0, 0, -2}).arcs, ElementsAre(1));
}

// Arc 2 has the largest value; arcs 0 and 3 exclude it; of the others arc 1 is the cheaper one of
// two with equal values, which exclude each other; the value of arc 5 is rounding.
TEST(RoundValues, TakesLargerValuesFirstThenCheaperArcs) {
  Component component = core::make_component({4, 4});
  const std::vector<std::vector<Index>> arcs = {{1, 1}, {2, 3}, {1, 2}, {3, 2}, {2, 4}, {4, 4}};
  const std::vector<double> costs = {-9, -5, -1, -9, -4, -3};
  for (std::size_t a = 0; a < arcs.size(); ++a) core::append_arc(component, arcs[a], costs[a]);
  const std::vector<ArcId> all = {0, 1, 2, 3, 4, 5};
  const std::vector<double> values = {0.4, 0.5, 0.6, 0.4, 0.5, 1e-9};
  const Packing packing = round_values(component, all, values);
  EXPECT_THAT(packing.arcs, ElementsAre(1, 2));
  EXPECT_EQ(packing.cost, -6);
}

TEST(LocalSearch, UncrossesTracks) {
  const Component component = support::whole_component(support::crossing_tracks().problem);
  Packing packing = greedy(component, component.costs);
  Random random(1);
  Random multipliers(1);
  const std::vector<double> u = support::feasible_multipliers(component, multipliers);
  LocalSearch(component, u).improve(packing, 0, -kInfinity, random, {});
  EXPECT_EQ(packing.cost, -8);
}

TEST(LocalSearch, NeverWorsensAndStaysFeasible) {
  int num_improved = 0;
  int num_optimal = 0;
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    LocalSearch search(component, u);
    for (const Packing& start : {Packing{}, greedy(component, component.costs)}) {
      Packing packing = start;
      search.improve(packing, 1 + static_cast<std::int64_t>(seed % 50), -kInfinity, random, {});
      EXPECT_EQ(packing_fault(component, packing), "");
      EXPECT_LE(packing.cost, start.cost);
      EXPECT_GE(packing.cost, support::best_cost(component) - kTie);
      num_improved += packing.cost < start.cost;
      num_optimal += packing.cost < support::best_cost(component) + kTie;
    }
  }
  EXPECT_GT(num_improved, 800) << "from nothing nearly always";
  EXPECT_GT(num_optimal, 1400) << "of 1600: small components are easy";
}

TEST(LocalSearch, IsDeterministicForAStateOfRandom) {
  const Component component = large_component(3);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  Packing one;
  Packing two;
  Random first(9);
  Random second(9);
  LocalSearch(component, u).improve(one, 500, -kInfinity, first, {});
  LocalSearch(component, u).improve(two, 500, -kInfinity, second, {});
  EXPECT_EQ(one.arcs, two.arcs);
  EXPECT_EQ(first(), second());
}

// Whether kicks were drawn shows in the state of `random`.
TEST(LocalSearch, StopsKickingAtTheGoal) {
  const Component component = large_component(4);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  LocalSearch search(component, u);
  Packing packing;
  Random kicks(5);
  search.improve(packing, 1000, -1, kicks, {});
  EXPECT_LE(packing.cost, -1);
  EXPECT_EQ(kicks(), Random(5)()) << "the descent alone reached the goal";
  Packing again;
  Random unlimited(5);
  search.improve(again, 1000, -kInfinity, unlimited, {});
  EXPECT_NE(unlimited(), Random(5)());
}

TEST(LocalSearch, StopsAtTheDeadline) {
  const Component component = large_component(5);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  Packing packing = greedy(component, component.costs);
  const double before = packing.cost;
  Random kicks(5);
  const core::Stopwatch watch;
  LocalSearch(component, u)
      .improve(packing, 1'000'000'000, -kInfinity, kicks, core::Deadline(0.01));
  EXPECT_LT(watch.seconds(), 5);
  EXPECT_LE(packing.cost, before);
  EXPECT_EQ(packing_fault(component, packing), "");
}

TEST(LocalSearch, OfZeroKicksOnlyDescends) {
  const Component component = large_component(6);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  Packing packing;
  Random kicks(5);
  LocalSearch(component, u).improve(packing, 0, -kInfinity, kicks, {});
  EXPECT_LT(packing.cost, 0);
  EXPECT_EQ(kicks(), Random(5)());
}

TEST(CoreArcs, AreThoseOfLeastReducedCostAndThoseToKeep) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random, 2);
    const std::vector<double> reduced = reduced_costs(component, u);
    const double gap = random.uniform(0, 15);
    const std::vector<ArcId> keep = greedy(component, component.costs).arcs;
    std::vector<ArcId> expected = keep;
    for (ArcId a = 0; a < reduced.size(); ++a) {
      if (reduced[a] < gap) expected.push_back(a);
    }
    std::sort(expected.begin(), expected.end());
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(core_arcs(component, u, gap, 1000, keep), expected);
  }
}

TEST(CoreArcs, AreLimitedToTheCheapestPerIndex) {
  const Component component = large_component(7);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random, 2);
  std::vector<double> reduced = reduced_costs(component, u);
  const std::vector<ArcId> few = core_arcs(component, u, kInfinity, 1, {});
  ASSERT_EQ(few.size(), component.num_indices());
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  double dearest = 0;
  for (const ArcId a : few) dearest = std::max(dearest, reduced[a]);
  std::sort(reduced.begin(), reduced.end());
  EXPECT_EQ(dearest, reduced[few.size() - 1]);
}

TEST(CoreArcs, OfTheGapHoldEveryBetterPacking) {
  int num_better = 0;
  int num_left_out = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component(seed);
    Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    const Packing known = greedy(component, component.costs);
    const double gap = known.cost - support::sum_of(u);
    const std::vector<ArcId> arcs = core_arcs(component, u, gap, 1000, {});
    num_left_out += static_cast<int>(component.num_arcs() - arcs.size());
    for (const Packing& packing : support::all_packings(component)) {
      if (packing.cost >= known.cost - kTie) continue;
      ++num_better;
      EXPECT_TRUE(
          std::includes(arcs.begin(), arcs.end(), packing.arcs.begin(), packing.arcs.end()));
    }
  }
  EXPECT_GT(num_left_out, 300);
  EXPECT_GT(num_better, 300);
}

TEST(SearchCore, ReturnsAPackingOfTheComponentNoDearerThanTheStart) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random, 1);
    const double lower = support::sum_of(u);
    CoreSearchOptions options;
    options.arcs_per_index = 1 + random.below(3);
    options.kicks_per_index = static_cast<int>(random.below(5));
    for (const Packing& start : {Packing{}, greedy(component, component.costs)}) {
      const double gap = random.uniform(0, 1.1) * (start.cost - lower);
      const Packing found = search_core(component, u, gap, start, options, random, {});
      EXPECT_EQ(packing_fault(component, found), "");
      EXPECT_LE(found.cost, start.cost);
      EXPECT_GE(found.cost, support::best_cost(component) - kTie);
    }
  }
}

TEST(SearchCore, KeepsAStartThatTheSearchCannotImprove) {
  Component component = core::make_component({1, 1});
  core::append_arc(component, std::vector<Index>{1, 1}, -5);
  Random random(1);
  const Packing found =
      search_core(component, std::vector<double>{0, -5, 0, 0}, 0, {{0}, -5}, {}, random, {});
  EXPECT_THAT(found.arcs, ElementsAre(0));
  EXPECT_EQ(found.cost, -5);
}

TEST(SearchCore, StopsAtTheGoalAndAtTheDeadline) {
  const Component component = large_component(8);
  Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  CoreSearchOptions options;
  options.goal = -1;
  Random kicks(5);
  const Packing quick = search_core(component, u, kInfinity, {}, options, kicks, {});
  EXPECT_LE(quick.cost, -1);
  EXPECT_EQ(kicks(), Random(5)());
  options.goal = -kInfinity;
  options.kicks_per_index = 100'000'000;
  const core::Stopwatch watch;
  const Packing late =
      search_core(component, u, kInfinity, {}, options, kicks, core::Deadline(0.01));
  EXPECT_LT(watch.seconds(), 5);
  EXPECT_EQ(packing_fault(component, late), "");
}

}  // namespace
}  // namespace nda::recovery
