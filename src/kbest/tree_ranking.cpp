#include "kbest/tree_ranking.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cutting/branch_and_cut.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/master.hpp"
#include "kbest/clique_ranking.hpp"
#include "kbest/combinations.hpp"
#include "kbest/nearby_packings.hpp"
#include "kbest/refunds.hpp"
#include "kbest/slack_ranking.hpp"
#include "solve/component_solver.hpp"

// Branch and cut for k packings is that for the best one, but for three things: the cutoff is the
// k-th of those known; what ends a node lists k packings; and a packing that solves a linear
// program ends nothing, as long as there is a pair of rows on which others differ.  Cuts and fixing
// by reduced costs keep every packing below the cutoff, so nothing else changes.
//
// The children of a branching exclude each other and leave nothing out: Lawler's partition (1972),
// by pairs of rows instead of arcs.

namespace nda::kbest {
namespace {

using core::ArcId;

// Trees that came to an end had done this much by then; those that had not were far from it.
constexpr double kTrialShare = 0.25;
constexpr double kLeastProgress = 0.2;
constexpr double kGoodProgress = 0.6;
constexpr double kMostExtension = 4;

bool is_hopeless(double progress, double share) {
  return (share > kTrialShare && progress < kLeastProgress) ||
         (share > 1 && progress < kGoodProgress) || share > kMostExtension;
}

cutting::LeafFinds list_leaf(const bnb::SlackProblem& problem,
                             double budget,
                             std::size_t k,
                             const bnb::SlackLimits& limits) {
  std::vector<std::uint32_t> names(problem.num_arcs());
  std::iota(names.begin(), names.end(), 0u);
  Combinations combinations;
  const SlackRanking ranking = rank_slack(problem, budget, k, limits, names, combinations);
  cutting::LeafFinds finds{{}, ranking.complete, ranking.nodes, ranking.work, {}};
  for (const Ranked& ranked : ranking.packings) {
    if (!finds.packings.empty() && limits.deadline.reached()) {
      finds.complete = false;
      break;
    }
    std::vector<std::uint32_t>& arcs = finds.packings.emplace_back(combinations.arcs(ranked.arcs));
    std::sort(arcs.begin(), arcs.end());
  }
  return finds;
}

// Multipliers are no larger than what two arcs cost in every dimension.
double rounding_of(const core::Component& component) {
  const double largest = 2 * component.num_dimensions() * core::largest_cost(component);
  return pipeline::precision_of(component.num_slots(), largest, {}).error;
}

std::vector<ArcId> affordable(const bnb::SlackProblem& slack, double budget) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < slack.num_arcs(); ++a) {
    if (slack.reduced(a) < budget) arcs.push_back(a);
  }
  return arcs;
}

}  // namespace

TreeRanking rank_by_tree(const core::Component& component,
                         const bnb::SlackProblem& slack,
                         double budget,
                         double margin,
                         const bnb::SlackLimits& limits,
                         PackingBuffer& known,
                         double leaf_work) {
  const core::Component refunding = with_refunds(component, slack);
  const double empty = empty_slack(slack);
  const double rounding = rounding_of(refunding);
  cutting::Master master = refunding_master(refunding, affordable(slack, budget), slack);
  cutting::LeafRanks ranks;
  ranks.k = known.capacity();
  ranks.may_cover = may_rank_cliques(slack);
  ranks.least = -empty - rounding;
  ranks.list = [&](const bnb::SlackProblem& leaf, double below, const bnb::SlackLimits& most) {
    return list_leaf(leaf, below, known.capacity(), most);
  };
  const auto cutoff = [&] { return std::min(budget, known.cutoff() - margin) - empty + rounding; };
  const auto offer = [&](const cutting::Master&, const core::Packing* found) {
    if (found != nullptr) {
      const double cost = slack_of_packing(slack, found->arcs);
      if (cost < kInfinity) known.add({found->arcs, cost});
    }
    return cutoff();
  };
  cutting::BranchAndCutLimits tree_limits;
  tree_limits.max_nodes = limits.max_nodes;
  // Searches end most nodes, whatever cuts would gain beyond those over three indices.
  tree_limits.node_patterns = 0;
  tree_limits.thorough = false;
  tree_limits.leaf_work = leaf_work;
  tree_limits.context.deadline = limits.deadline;
  tree_limits.ranks = &ranks;
  cutting::BranchAndCut* running = nullptr;
  bool given_up = false;
  tree_limits.pause = [&](std::int64_t, double work) {
    given_up = given_up || is_hopeless(running->progress(), work / limits.max_work);
    return given_up ? -kInfinity : cutoff();
  };
  cutting::BranchAndCut tree(refunding, master, cutoff(), tree_limits, offer);
  running = &tree;
  const cutting::BranchAndCutResult result = tree.run();
  return {result.complete && !given_up, result.nodes, result.work};
}

}  // namespace nda::kbest
