#include "recovery/master_search.hpp"

#include <gtest/gtest.h>

#include "recovery/greedy.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;

constexpr double kTie = 1e-7;

std::vector<core::ArcId> arcs_before(const Component& component, double share) {
  std::vector<core::ArcId> arcs;
  for (core::ArcId a = 0; a < share * static_cast<double>(component.num_arcs()); ++a)
    arcs.push_back(a);
  return arcs;
}

struct Outcome {
  Packing start;
  Packing found;
};

// Greedy, then the search by the multipliers of a master with the cuts over the first indices of
// any three dimensions; `share` of the arcs are live.
Outcome search(const Component& component, double share, std::uint64_t seed) {
  Outcome outcome;
  outcome.start = greedy(component, component.costs);
  cutting::Master master(
      component, arcs_before(component, share), std::vector<double>(component.num_slots(), 0.0));
  for (std::size_t k = 2; k < component.sizes.size(); ++k) {
    master.add({{component.offset[k - 2] + 1, component.offset[k - 1] + 1, component.offset[k] + 1},
                {1, 1, 1},
                2});
  }
  EXPECT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
  MasterSearchOptions options;
  options.max_work = 2e6;
  core::Random random(seed);
  outcome.found = search_by_master(component, master, outcome.start, {{}}, options, random, {});
  return outcome;
}

// The best multipliers leave thousands of arcs without any reduced cost, which says nothing of
// their order; the values of the relaxed point do.
TEST(RelaxedPoint, GuidesBetterThanItsReducedCosts) {
  double by_values = 0, by_reduced_costs = 0;
  int num_better = 0, num_worse = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::large_component(seed);
    cutting::Master master(
        component, arcs_before(component, 1), std::vector<double>(component.num_slots(), 0.0));
    ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
    const double rounded = round_values(component, master.arcs(), master.values()).cost;
    const double reduced = dual_greedy(component, master.u()).cost;
    by_values += rounded;
    by_reduced_costs += reduced;
    num_better += rounded < reduced;
    num_worse += rounded > reduced;
  }
}

TEST(MasterSearch, FindsTheOptimumOfSmallComponents) {
  int num_missed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    if (component.num_arcs() == 0) continue;
    const Outcome outcome = search(component, 1, seed);
    ASSERT_EQ(support::packing_fault(component, outcome.found), "");
    ASSERT_LE(outcome.found.cost, outcome.start.cost);
    num_missed += outcome.found.cost > std::min(0.0, support::best_cost(component)) + kTie;
  }
  EXPECT_LT(num_missed, 10);
}

TEST(MasterSearch, KeepsAStartThatUsesOtherArcs) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    if (component.num_arcs() == 0) continue;
    const Outcome outcome = search(component, 0.5, seed);
    ASSERT_EQ(support::packing_fault(component, outcome.found), "");
    ASSERT_LE(outcome.found.cost, outcome.start.cost);
  }
}

}  // namespace
}  // namespace nda::recovery
