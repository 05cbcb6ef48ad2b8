#include "cutting/branch_and_cut.hpp"

#include <gtest/gtest.h>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::Component;
using core::Packing;

struct Outcome {
  BranchAndCutResult result;
  Packing best;
};

// Branches with hardly any cuts, or none at all, so that the tree has to do the work.
Outcome search(const Component& component, double cutoff, std::int64_t max_nodes, int rounds = 1) {
  Master master(component, all_arcs(component), no_multipliers(component));
  BranchAndCutLimits limits;
  limits.max_nodes = max_nodes;
  limits.root_rounds = limits.node_rounds = rounds;
  limits.leaf_work = 0;
  Outcome outcome;
  outcome.best.cost = cutoff;
  BranchAndCut tree(component, master, cutoff, limits, [&](const Master&, const Packing* packing) {
    if (packing != nullptr && packing->cost < outcome.best.cost) outcome.best = *packing;
    return outcome.best.cost - 1e-7;
  });
  outcome.result = tree.run();
  return outcome;
}

TEST(BranchAndCut, FindsTheOptimumAndProvesIt) {
  std::int64_t nodes = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Component component = fractional_component(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, 1e-6, 1000000);
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_NEAR(std::min(0.0, outcome.best.cost), best, 1e-6) << "seed " << seed;
    if (!outcome.best.arcs.empty()) {
      ASSERT_EQ(support::packing_fault(component, outcome.best), "") << "seed " << seed;
    }
    nodes += outcome.result.nodes;
  }
  EXPECT_GT(nodes, 1100);  // some needed branching
}

TEST(BranchAndCut, NeedsNoCuts) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, 1e-6, 1000000, 0);
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_NEAR(std::min(0.0, outcome.best.cost), best, 1e-6) << "seed " << seed;
  }
}

TEST(BranchAndCut, ItsBoundHoldsWhereverItStops) {
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Component component = fractional_component(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, 1e-6, 1 + static_cast<std::int64_t>(seed % 3));
    ASSERT_LE(outcome.result.lower, best + 1e-6) << "seed " << seed;
    stopped += outcome.result.complete ? 0 : 1;
  }
  EXPECT_GT(stopped, 10);
}

TEST(BranchAndCut, ACutoffBelowTheOptimumLeavesNothing) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    const double best = support::best_cost(component);
    const Outcome outcome = search(component, best - 0.01, 1000000);
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_TRUE(outcome.best.arcs.empty()) << "seed " << seed;
  }
}

// A pause that lowers the cutoff below all bounds ends the tree at once, with a bound that holds.
TEST(BranchAndCut, ObeysTheCutoffOfAPause) {
  int paused = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Component component = fractional_component(seed);
    Master master(component, all_arcs(component), no_multipliers(component));
    BranchAndCutLimits limits;
    limits.max_nodes = 1000000;
    limits.root_rounds = limits.node_rounds = 1;
    limits.leaf_work = 0;
    int pauses = 0;
    limits.pause = [&](std::int64_t, double) {
      ++pauses;
      return -1e9;
    };
    BranchAndCut tree(component, master, 1e-6, limits, [&](const Master&, const Packing*) {
      return pauses > 0 ? -1e9 : 1e-6;
    });
    const BranchAndCutResult result = tree.run();
    ASSERT_LE(pauses, 1) << "seed " << seed;
    if (pauses == 0) continue;  // ended without branching
    ++paused;
    ASSERT_TRUE(result.complete) << "seed " << seed;
    ASSERT_EQ(result.tree_nodes, 1) << "seed " << seed;
    ASSERT_LE(result.lower, support::best_cost(component) + 1e-6) << "seed " << seed;
  }
  EXPECT_GT(paused, 10);
}

}  // namespace
}  // namespace nda::cutting
