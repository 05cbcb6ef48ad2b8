#include "bnb/enumerate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/components.hpp"

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;
using support::packing_fault;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kTie = 1e-9;
constexpr std::int64_t kManyNodes = 10'000'000;

// What holds however the search ended.
void expect_sound(const Component& component,
                  double best,
                  double cutoff,
                  const SearchResult& result) {
  EXPECT_LE(std::min(result.lower, cutoff), best + kTie);
  if (result.found) {
    EXPECT_EQ(packing_fault(component, result.best), "");
    EXPECT_LT(result.best.cost, cutoff + kTie);
    EXPECT_TRUE(std::is_sorted(result.best.arcs.begin(), result.best.arcs.end()));
  }
  if (result.complete && result.found) {
    EXPECT_NEAR(result.best.cost, best, kTie);
  }
  if (result.complete && !result.found) {
    EXPECT_GE(best, cutoff - kTie);
  }
}

TEST(Enumerate, FindsTheEmptyPackingOfNoArcs) {
  const Component none = core::make_component({2, 1});
  const std::vector<double> u(none.num_slots(), 0.0);
  const SearchResult found = enumerate(none, u, 0.5, kManyNodes);
  EXPECT_TRUE(found.complete);
  EXPECT_TRUE(found.found);
  EXPECT_THAT(found.best.arcs, IsEmpty());
  EXPECT_EQ(found.best.cost, 0);
  const SearchResult none_below = enumerate(none, u, 0, kManyNodes);
  EXPECT_TRUE(none_below.complete);
  EXPECT_FALSE(none_below.found);
}

TEST(Enumerate, LeavesAnIndexUncoveredWhereThatIsCheaper) {
  // (1,1) -3, (1,2) -2, (2,1) -2: the cross -4 beats the straight -3.
  Component component = core::make_component({2, 2});
  core::append_arc(component, std::vector<Index>{1, 1}, -3);
  core::append_arc(component, std::vector<Index>{1, 2}, -2);
  core::append_arc(component, std::vector<Index>{2, 1}, -2);
  const std::vector<double> u = {0, -3, -2, 0, 0, 0};
  const SearchResult result = enumerate(component, u, kInfinity, kManyNodes);
  EXPECT_TRUE(result.complete);
  EXPECT_THAT(result.best.arcs, ElementsAre(1, 2));
  EXPECT_EQ(result.best.cost, -4);
  EXPECT_GT(result.nodes, 1);
}

TEST(Enumerate, AgreesWithBruteForceForAnyMultipliersAndCutoff) {
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const std::vector<double> u =
        support::feasible_multipliers(component, random, random.below(3) == 0 ? 3.0 : 0.0);
    const double best = support::best_cost(component);
    for (const double cutoff : {kInfinity, best + random.uniform(0.001, 5), best - 0.001, 0.25}) {
      SCOPED_TRACE(cutoff);
      const SearchResult result = enumerate(component, u, cutoff, kManyNodes);
      EXPECT_TRUE(result.complete);
      EXPECT_EQ(result.found, best < cutoff);
      expect_sound(component, best, cutoff, result);
      EXPECT_GE(result.lower, std::min(best, cutoff) - kTie) << "a complete search proves the most";
    }
    if (HasFailure()) return;
  }
}

TEST(Enumerate, NumbersArcsOfItsComponentNotOfTheProblem) {
  const Component whole = support::random_component(5);
  std::vector<ArcId> odd;
  for (ArcId a = 1; a < whole.num_arcs(); a += 2) odd.push_back(a);
  const Component cut = core::Cutter().cut(whole, odd);
  core::Random random(1);
  const SearchResult result =
      enumerate(cut, support::feasible_multipliers(cut, random), kInfinity, kManyNodes);
  EXPECT_EQ(packing_fault(cut, result.best), "");
}

TEST(Enumerate, StaysSoundUnderANodeLimit) {
  int num_incomplete = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random, 2);
    const double best = support::best_cost(component);
    const std::int64_t max_nodes = 1 + static_cast<std::int64_t>(random.below(6));
    const double cutoff = random.below(2) == 0 ? kInfinity : best + random.uniform(-1, 3);
    const SearchResult result = enumerate(component, u, cutoff, max_nodes);
    EXPECT_LE(result.nodes, max_nodes);
    expect_sound(component, best, cutoff, result);
    num_incomplete += !result.complete;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_incomplete, 1000);
}

// 12 disjoint copies of the odd cycle: bound -18, optimum -12, hopeless to enumerate.
Component many_odd_cycles() {
  constexpr Index kCopies = 12;
  Component component = core::make_component({kCopies, kCopies, kCopies});
  for (Index i = 1; i <= kCopies; ++i) {
    core::append_arc(component, std::vector<Index>{0, i, i}, -1);
  }
  for (Index i = 1; i <= kCopies; ++i) {
    core::append_arc(component, std::vector<Index>{i, 0, i}, -1);
    core::append_arc(component, std::vector<Index>{i, i, 0}, -1);
  }
  return component;
}

TEST(Enumerate, StopsAtTheDeadline) {
  const Component component = many_odd_cycles();
  std::vector<double> u(component.num_slots(), -0.5);
  for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
  std::stop_source stop;
  stop.request_stop();
  for (const core::Deadline& deadline : {core::Deadline(0), core::Deadline(60, stop.get_token())}) {
    const SearchResult result = enumerate(component, u, kInfinity, kManyNodes, deadline);
    EXPECT_FALSE(result.complete);
    EXPECT_LT(result.nodes, 10000);
    EXPECT_NEAR(result.lower, -18, kTie);
    if (result.found) {
      EXPECT_EQ(packing_fault(component, result.best), "");
    }
  }
}

}  // namespace
}  // namespace nda::bnb
