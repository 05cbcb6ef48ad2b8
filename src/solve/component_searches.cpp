#include <algorithm>
#include <cmath>
#include <utility>

#include "bnb/component_slack.hpp"
#include "bnb/cover.hpp"
#include "bnb/slack_search.hpp"
#include "recovery/greedy.hpp"
#include "relax/ascent.hpp"
#include "relax/relaxed_dual.hpp"
#include "solve/component_solver.hpp"

// How a component may end before any linear program: by enumeration or covers by cliques where it
// is small, by complementary slackness where it has no gap.

namespace nda::pipeline {
namespace {

using core::ArcId;

// Of coordinate ascent, until no multiplier moves by more than a part of the dearest arc.  What the
// multipliers leave to a search takes longer than some more sweeps.
constexpr int kMostSweeps = 80;
constexpr double kLeastMove = 0x1p-11;
constexpr std::int64_t kEnumerationNodes = 200000;
// Better multipliers end what takes longer sooner.
constexpr double kEnumerationWork = 1e4;
// As long as a linear program would take.
constexpr double kEarlyCliqueWork = 1e5;
// As many times more arcs than those that are enumerated first are covered by cliques, in the end.
constexpr std::size_t kCliqueArcsPerExactArc = 2;
// Where the search was longer, there is a gap that no multipliers close.
constexpr std::int64_t kFewNodes = 20;
// A packing that costs so little beyond the multipliers, as a share of the dearest arc, is looked
// for; then for one that costs so many times as much, as long as there is hardly any choice.
constexpr double kFirstFree = 0x1p-22;
constexpr double kWidenFree = 64;
constexpr double kFreeWork = 1e5;
// Of the gap.
constexpr double kFirstShare = 0.5;
// Of a search within the whole gap; where more arcs than this are left it would not end.
constexpr double kGapWork = 3e4;
constexpr std::size_t kGapArcsPerIndex = 4;
// Ascent and the greedy packing of more would take longer.
constexpr std::size_t kMostNearArcs = 10000;
constexpr double kFreeWorkPerIndex = 50;

bnb::SlackLimits short_search() {
  bnb::SlackLimits limits;
  limits.max_work = kGapWork;
  return limits;
}

}  // namespace

// Coordinate ascent leaves little between the multipliers and the packing that they guide to; a hot
// start has ascended before.
void ComponentSolver::enumerate() {
  state_.method = "enumeration";
  if (!is_hot_ && component_.num_arcs() <= kMostNearArcs) ascend();
  offer(recovery::dual_greedy(component_, state_.u, deadline_), "greedy");
  if (state_.complete) return;
  bnb::SlackLimits limits;
  if (options_.method == Method::kExact)
    limits.max_nodes = kEnumerationNodes;
  else
    limits.max_work = kEnumerationWork;
  search_gap(limits, "enumeration");
  if (state_.complete && state_.nodes <= kFewNodes && !is_hot_) settle_best();
  if (!state_.complete) search_cliques();
}

void ComponentSolver::ascend() {
  relax::Ascent ascent(component_, core::all_arcs(component_), state_.u, relax::kFastShare);
  ascent.climb(kMostSweeps, kLeastMove * core::largest_cost(component_), deadline_);
  std::vector<double> u = ascent.u();
  const double certificate = relax::make_feasible(component_, u, deadline_);
  accept_multipliers(std::move(u), certificate, "enumeration");
}

// Covers by cliques end some small components that multipliers do not.
void ComponentSolver::search_cliques() {
  if (component_.num_arcs() > kCliqueArcsPerExactArc * options_.branch.exact_arcs) return;
  if (state_.nodes >= options_.branch.max_nodes || std::exchange(tried_cliques_, true)) return;
  state_.method = "clique search";
  bnb::CliqueLimits limits;
  limits.max_nodes = options_.branch.max_nodes - state_.nodes;
  limits.max_work = kEarlyCliqueWork;
  limits.deadline = deadline_;
  const std::vector<double> none(component_.num_slots(), 0.0);
  const bnb::SearchResult result =
      bnb::cover(component_, core::all_arcs(component_), none, cutoff(), limits);
  state_.nodes += result.nodes;
  if (result.found) offer(result.best, "clique search");
  if (!result.complete) return;
  searched_cliques_ = true;
  raise_bound(cutoff(), "clique search");
}

// There is nothing better than the best.  The multipliers should prove as much of that as they can
// by themselves.
void ComponentSolver::settle_best() {
  relax::LagrangianOptions loop = loop_options(component_);
  loop.max_evaluations = options_.branch.node_evaluations;
  loop.goal = state_.best.cost - precision_.error;
  accept_dual(relax::maximize_dual(component_, state_.u, loop, {}), "enumeration");
}

// Where there is no gap and the multipliers are optimal, all that is in an optimal packing costs
// next to nothing beyond them, and little else does (complementary slackness).
void ComponentSolver::search_nearly_free() {
  // A better packing leaves less to look for, only better multipliers leave more.
  if (std::exchange(searched_free_at_, state_.certificate) == state_.certificate) return;
  const double largest = core::largest_cost(component_);
  bnb::SlackLimits limits;
  limits.step = precision_.step();
  limits.deadline = deadline_;
  limits.for_all = for_all_;
  limits.max_work = kFreeWork + kFreeWorkPerIndex * static_cast<double>(component_.num_indices());
  for (double budget = kFirstFree * largest; budget > 0 && !state_.complete; budget *= kWidenFree) {
    if (state_.certificate + budget >= cutoff()) return;
    const bnb::ComponentSlack slack = bnb::slack_of(component_, state_.u, budget, deadline_);
    if (deadline_.reached() || slack.arcs.size() > component_.num_indices()) return;
    limits.max_nodes = options_.branch.max_nodes - state_.nodes;
    const bnb::SlackResult found = bnb::search_slack(slack.problem, budget, limits);
    state_.nodes += found.nodes;
    state_.searches += found.fixing;
    limits.max_work -= found.work;
    if (!found.arcs.empty()) {
      std::vector<ArcId> arcs = core::at_positions(slack.arcs, found.arcs);
      offer(core::make_packing(component_, std::move(arcs)), "complementary slackness");
    }
    if (!found.complete) return;
    if (found.slack == kInfinity) continue;
    note_left(slack.arcs.size());
    enumerated_ = true;
    raise_bound(cutoff(), "complementary slackness");
  }
}

// What a warm start knows often leaves next to nothing to search.
void ComponentSolver::search_near_hint() {
  if (component_.num_arcs() > kGapArcsPerIndex * component_.num_indices()) return;
  state_.method = "slack search";
  search_gap(short_search(), "slack search");
}

// The multipliers of the relaxation guide to a packing that often leaves little to search, which
// then takes less time than the linear program.
void ComponentSolver::search_near_multipliers() {
  if (component_.num_arcs() > kMostNearArcs) return;
  state_.method = "slack search";
  offer(recovery::dual_greedy(component_, state_.u, deadline_), "greedy");
  if (close_enough()) return;
  search_gap(short_search(), "slack search");
}

// Good multipliers and a good packing leave little between them: all of it is searched.  The best
// packing is often nearer to the multipliers, and the search to the first that is found.
void ComponentSolver::search_gap(bnb::SlackLimits limits, const char* event) {
  const double gap = cutoff() - state_.certificate;
  limits.step = precision_.step();
  limits.deadline = deadline_;
  std::size_t left = 0;
  for (const double budget : {kFirstShare * gap, gap}) {
    const bnb::ComponentSlack slack = bnb::slack_of(component_, state_.u, budget, deadline_);
    if (deadline_.reached()) return;
    limits.max_nodes = std::min(limits.max_nodes, options_.branch.max_nodes - state_.nodes);
    const bnb::SlackResult found = bnb::search_slack(slack.problem, budget, limits);
    state_.nodes += found.nodes;
    state_.searches += found.fixing;
    limits.max_work -= found.work;
    if (!found.arcs.empty()) {
      std::vector<ArcId> arcs = core::at_positions(slack.arcs, found.arcs);
      offer(core::make_packing(component_, std::move(arcs)), event);
    }
    if (!found.complete) return;
    left = slack.arcs.size();
    if (found.slack < kInfinity) break;
  }
  note_left(left);
  enumerated_ = true;
  raise_bound(cutoff(), event);
}

}  // namespace nda::pipeline
