#include "cutting/tree_search.hpp"

#include <gtest/gtest.h>

#include "cutting/cutting_support.hpp"
#include "nda/proof.hpp"
#include "support/other_orders.hpp"

namespace nda::cutting {
namespace {

using core::Component;
using core::Packing;

// Every node but the first is left to the next round.
constexpr TreeShape kBreakOffAtOnce = {0, 0};

struct Outcome {
  BranchAndCutResult result;
  Packing best;
};

// Branches with hardly any cuts, so that the tree has to do the work.
Outcome search(const Component& component,
               const core::ForAll& for_all,
               std::int64_t max_nodes = 1000000,
               bnb::ProofLog* proof = nullptr) {
  Master master(component, all_arcs(component), no_multipliers(component));
  BranchAndCutLimits limits;
  limits.max_nodes = max_nodes;
  limits.root_rounds = limits.node_rounds = 1;
  limits.leaf_work = 0;
  limits.margin = 1e-7;
  limits.context.proof = proof;
  Outcome outcome;
  outcome.best.cost = 1e-6;
  const PackingOffer offer = [&](const Master&, const Packing* packing) {
    if (packing != nullptr && packing->cost < outcome.best.cost) outcome.best = *packing;
    return outcome.best.cost - 1e-7;
  };
  limits.context.for_all = for_all;
  outcome.result = search_tree(component, master, 1e-6, limits, offer, kBreakOffAtOnce);
  return outcome;
}

// The component as a problem whose singletons are free.
Problem problem_of(const Component& component) {
  ProblemBuilder builder(component.sizes);
  for (core::ArcId a = 0; a < component.num_arcs(); ++a) {
    std::vector<Index> tuple;
    for (int k = 0; k < component.num_dimensions(); ++k) tuple.push_back(component.index(k, a));
    builder.add_arc(tuple, component.costs[a]);
  }
  return std::move(builder).build();
}

TEST(TreeSearch, FindsTheOptimumAndProvesIt) {
  std::int64_t nodes = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Component component = fractional_component(seed);
    const Outcome outcome = search(component, {});
    ASSERT_TRUE(outcome.result.complete) << "seed " << seed;
    ASSERT_TRUE(outcome.result.exhaustive) << "seed " << seed;
    ASSERT_NEAR(std::min(0.0, outcome.best.cost), support::best_cost(component), 1e-6)
        << "seed " << seed;
    nodes += outcome.result.nodes;
  }
  EXPECT_GT(nodes, 1100);  // some needed rounds
}

TEST(TreeSearch, DoesTheSameInWhateverOrderItsRoundsAreDone) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    const Outcome one = search(component, {});
    for (const core::ForAll& for_all :
         {core::ForAll(support::backwards), core::ForAll(support::at_once)}) {
      const Outcome other = search(component, for_all);
      ASSERT_EQ(other.result.nodes, one.result.nodes) << "seed " << seed;
      ASSERT_EQ(other.result.lower, one.result.lower) << "seed " << seed;
      ASSERT_EQ(other.best.arcs, one.best.arcs) << "seed " << seed;
    }
  }
}

TEST(TreeSearch, ItsBoundHoldsWhereverItStops) {
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Component component = fractional_component(seed);
    const auto limit = 1 + static_cast<std::int64_t>(seed % 5);
    const Outcome outcome = search(component, {}, limit);
    ASSERT_LE(outcome.result.nodes, limit) << "seed " << seed;
    ASSERT_LE(outcome.result.lower, support::best_cost(component) + 1e-6) << "seed " << seed;
    stopped += outcome.result.complete ? 0 : 1;
  }
  EXPECT_GT(stopped, 10);
}

TEST(TreeSearch, ItsProofIsThatOfOneTree) {
  std::size_t branchings = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const Component component = fractional_component(seed);
    bnb::ProofLog log(component, std::vector<double>(component.num_slots(), 0.0), 1e-9);
    const Outcome outcome = search(component, core::ForAll(support::at_once), 1000000, &log);
    const Problem problem = problem_of(component);
    Proof proof;
    proof.sizes.assign(problem.sizes().begin(), problem.sizes().end());
    proof.num_arcs = problem.num_arcs();
    proof.parts = {log.take()};
    const ProofReport report = check_proof(problem, proof);
    ASSERT_TRUE(report.passed()) << "seed " << seed << ": " << report.fault;
    ASSERT_NEAR(report.lower_bound, std::min(0.0, outcome.best.cost), 1e-6) << "seed " << seed;
    branchings += proof.parts.front().steps.size() / 2;
  }
  EXPECT_GT(branchings, 100u);
}

}  // namespace
}  // namespace nda::cutting
