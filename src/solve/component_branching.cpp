#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "recovery/core_search.hpp"
#include "relax/lagrangian.hpp"
#include "solve/component_solver.hpp"
#include "solve/tree_reduction.hpp"

// Lagrangian branch and bound on a component: every node is relaxed, fixed by reduced costs and
// split anew.

namespace nda::pipeline {

using core::ArcId;
using core::Component;
using core::Packing;

namespace {

// The arcs that cost less than leaving their indices uncovered: no other is needed, and the steps
// of a proof do not know any other.
std::vector<ArcId> worthwhile_arcs(const Component& component) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (component.costs[a] < 0) arcs.push_back(a);
  }
  return arcs;
}

// Arcs that it left.
std::size_t num_arcs(const bnb::Reduction& reduction) {
  std::size_t count = reduction.taken.arcs.size();
  for (const Component& part : reduction.parts) count += part.num_arcs();
  return count;
}

}  // namespace

// By the relaxation; packings are looked for within what its bound leaves of the cutoff.
bnb::NodeBound ComponentSolver::bound_node(const Component& node,
                                           std::span<const double> warm,
                                           double cutoff) {
  relax::LagrangianOptions loop = loop_options(node);
  loop.max_evaluations = options_.branch.node_evaluations;
  loop.recovery_interval = 0;
  loop.goal = cutoff;
  // Coordinate ascent stalls at kinks: a tree bounded by it need not end.
  if (loop.dual_method == DualMethod::kCoordinate) loop.dual_method = DualMethod::kBundleTrust;
  relax::LagrangianResult dual = relax::maximize_dual(node, warm, loop, {});
  state_.evaluations += dual.evaluations;
  bnb::NodeBound bound{std::move(dual.u), dual.lower, {}};
  const double inherited = std::accumulate(warm.begin(), warm.end(), 0.0);
  if (inherited > bound.lower) bound = {{warm.begin(), warm.end()}, inherited, {}};
  if (bound.lower >= cutoff) return bound;
  recovery::CoreSearchOptions search;
  search.kicks_per_index = 0;
  search.goal = bound.lower;
  core::Random random(seed_);
  bound.packing =
      recovery::search_core(node, bound.u, cutoff - bound.lower, {}, search, random, deadline_);
  return bound;
}

bnb::BranchLimits ComponentSolver::branch_limits() const {
  bnb::BranchLimits limits;
  limits.max_nodes = options_.branch.max_nodes - state_.nodes;
  limits.margin = precision_.margin;
  limits.error = precision_.error;
  limits.gap = allowed_gap_;
  limits.deadline = deadline_;
  return limits;
}

void ComponentSolver::take_tree(const bnb::SearchResult& result) {
  state_.nodes += result.nodes;
  state_.searches += result.searches;
  state_.branching += result.branching;
  if (!result.found) return;
  Packing packing;
  packing.cost = result.best.cost;
  packing.arcs = core::arcs_from_original(component_, result.best.arcs);
  offer(packing, "branch and bound");
}

void ComponentSolver::branch() {
  state_.method = "branch and bound";
  core::Cutter cutter;
  const Component worthwhile = cutter.cut(component_, worthwhile_arcs(component_));
  const std::vector<double> u = core::restrict_slots(component_, state_.u, worthwhile);
  bnb::Collaborators collaborators;
  collaborators.bound = [this](const Component& node, std::span<const double> warm, double cutoff) {
    return bound_node(node, warm, cutoff);
  };
  collaborators.reduce = [&](const Component& node, const bnb::NodeBound& bound, double cutoff) {
    bnb::Reduction reduction = reduce_node(node, bound, cutoff);
    if (&node != &worthwhile) return reduction;  // else it is the root
    note_left(num_arcs(reduction));
    if (options_.method == Method::kExact) state_.live_arcs = num_arcs(reduction);
    return reduction;
  };
  bnb::BranchLimits limits = branch_limits();
  std::optional<bnb::ProofLog> proof;
  if (proof_ != nullptr) limits.proof = &proof.emplace(proof_->fork());
  const bool coarse = limits.gap > limits.margin;
  const double cutoff = state_.best.cost - std::max(limits.margin, limits.gap);
  const bnb::SearchResult result =
      bnb::branch_and_bound(worthwhile, u, cutoff, collaborators, limits);
  take_tree(result);
  const double missed = coarse ? limits.gap : limits.error;
  const double lower = result.complete ? state_.best.cost - missed : std::min(result.lower, cutoff);
  if (proof && lower > state_.lower) proof_->replace(std::move(*proof));
  raise_bound(lower, "branch and bound");
}

}  // namespace nda::pipeline
