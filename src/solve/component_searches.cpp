#include <algorithm>
#include <cmath>
#include <utility>

#include "bnb/component_slack.hpp"
#include "bnb/cover.hpp"
#include "bnb/enumerate.hpp"
#include "solve/component_solver.hpp"

// How a component may end before any linear program: by enumeration or covers by cliques where it
// is small, by complementary slackness where it has no gap.

namespace nda::pipeline {
namespace {

using core::ArcId;

constexpr std::int64_t kEnumerationNodes = 200000;
// Better multipliers, those of a linear program, end what takes longer sooner.
constexpr std::int64_t kNodesBeforeRelaxation = 20;
// As long as a linear program would take.
constexpr std::size_t kCliqueArcsPerExactArc = 2;
constexpr double kEarlyCliqueWork = 1e5;
// Where covers by cliques were needed, multipliers will not close the gap.
constexpr int kEvaluationsAfterCliques = 3;
constexpr int kFeasibleSweeps = 3;
// A packing that costs so little beyond the multipliers, as a share of the dearest arc, is looked
// for; then for one that costs so many times as much, as long as there is hardly any choice.
constexpr double kFirstFree = 0x1p-22;
constexpr double kWidenFree = 64;
constexpr double kFreeWork = 1e5;
// Of a search within the whole gap; where more arcs than this are left it would not end.
constexpr double kGapWork = 3e4;
constexpr std::size_t kGapArcsPerIndex = 4;
constexpr double kFreeWorkPerIndex = 50;

}  // namespace

void ComponentSolver::enumerate() {
  state_.method = "enumeration";
  std::vector<double> u = state_.u;
  for (int sweep = 1; sweep < kFeasibleSweeps; ++sweep) {
    if (relax::make_feasible(component_, u, deadline_) == -kInfinity) return;
  }
  const std::int64_t patience =
      options_.method == Method::kExact ? kEnumerationNodes : kNodesBeforeRelaxation;
  const std::int64_t max_nodes = std::min(patience, options_.branch.max_nodes);
  const bnb::SearchResult result =
      bnb::enumerate(component_, u, precision_.margin, max_nodes, deadline_);
  state_.nodes += result.nodes;
  if (result.found) offer(result.best, "enumeration");
  if (!result.complete) return;
  enumerated_ = true;
  settle_best(u, options_.branch.node_evaluations, "enumeration");
}

// Covers by cliques end some small components that multipliers do not.
void ComponentSolver::search_cliques() {
  if (component_.num_arcs() > kCliqueArcsPerExactArc * options_.branch.exact_arcs) return;
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
  settle_best(state_.u, kEvaluationsAfterCliques, "clique search");
}

// There is nothing better than the best.  The multipliers should prove as much of that as they can
// by themselves.
void ComponentSolver::settle_best(std::span<const double> u,
                                  int max_evaluations,
                                  const char* event) {
  relax::LagrangianOptions loop = loop_options(component_);
  loop.max_evaluations = std::min(max_evaluations, options_.branch.node_evaluations);
  loop.goal = state_.best.cost - precision_.error;
  accept_dual(relax::maximize_dual(component_, u, loop, {}), event);
  raise_bound(state_.best.cost - precision_.error, event);
}

// Where there is no gap and the multipliers are optimal, all that is in an optimal packing costs
// next to nothing beyond them, and little else does (complementary slackness).
void ComponentSolver::search_nearly_free() {
  // A better packing leaves less to look for, only better multipliers leave more.
  if (std::exchange(searched_free_at_, state_.certificate) == state_.certificate) return;
  double largest = 0;
  for (const double cost : component_.costs) largest = std::max(largest, std::abs(cost));
  bnb::SlackLimits limits;
  limits.deadline = deadline_;
  limits.max_work = kFreeWork + kFreeWorkPerIndex * static_cast<double>(component_.num_indices());
  for (double budget = kFirstFree * largest; budget > 0 && !state_.complete; budget *= kWidenFree) {
    if (state_.certificate + budget >= cutoff()) return;
    const bnb::ComponentSlack slack = bnb::slack_of(component_, state_.u, budget, deadline_);
    if (deadline_.reached() || slack.arcs.size() > component_.num_indices()) return;
    limits.max_nodes = options_.branch.max_nodes - state_.nodes;
    const bnb::SlackResult found = bnb::search_slack(slack.problem, budget, limits);
    state_.nodes += found.nodes;
    limits.max_work -= found.work;
    if (!found.arcs.empty()) {
      std::vector<ArcId> arcs = core::at_positions(slack.arcs, found.arcs);
      offer(core::make_packing(component_, std::move(arcs)), "complementary slackness");
    }
    if (!found.complete) return;
    if (found.slack == kInfinity) continue;
    enumerated_ = true;
    raise_bound(cutoff(), "complementary slackness");
  }
}

// Good multipliers and a good packing leave little between them: all of it is searched.
void ComponentSolver::search_gap() {
  if (component_.num_arcs() > kGapArcsPerIndex * component_.num_indices()) return;
  state_.method = "slack search";
  const double budget = cutoff() - state_.certificate;
  const bnb::ComponentSlack slack = bnb::slack_of(component_, state_.u, budget, deadline_);
  bnb::SlackLimits limits;
  limits.deadline = deadline_;
  limits.max_work = kGapWork;
  limits.max_nodes = options_.branch.max_nodes - state_.nodes;
  if (deadline_.reached()) return;
  const bnb::SlackResult found = bnb::search_slack(slack.problem, budget, limits);
  state_.nodes += found.nodes;
  if (!found.arcs.empty()) {
    std::vector<ArcId> arcs = core::at_positions(slack.arcs, found.arcs);
    offer(core::make_packing(component_, std::move(arcs)), "slack search");
  }
  if (!found.complete) return;
  enumerated_ = true;
  raise_bound(cutoff(), "slack search");
}

}  // namespace nda::pipeline
