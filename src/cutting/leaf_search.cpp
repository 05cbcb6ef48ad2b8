#include "cutting/leaf_search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "bnb/cover.hpp"
#include "cutting/master_slack.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kShrunk = 0.75;
constexpr double kMoreCredit = 4;      // of what failed
constexpr double kFirstShare = 0.125;  // of the gap
// Over many indices a search whose budget is a small part of the gap may only take a part of the
// credit: what fails early would have failed late.  With more arcs than indices it fails anyway.
constexpr double kFewIndices = 4000;

std::vector<ArcId> allowed(const Master& master) {
  std::vector<ArcId> arcs;
  std::ranges::copy_if(
      master.live(), std::back_inserter(arcs), [&](ArcId a) { return !master.forbidden(a); });
  return arcs;
}

// By slot: for those that must be covered, more than covering them can ever cost, as an arc takes
// the place of one other at most in every dimension.
std::vector<double> demands(const core::Component& component, const Master& master) {
  double largest = 0;
  for (const ArcId a : master.live()) largest = std::max(largest, std::abs(component.costs[a]));
  std::vector<double> u(component.num_slots(), 0.0);
  for (std::uint32_t slot = 0; slot < u.size(); ++slot) {
    if (master.forced(slot)) u[slot] = (component.num_dimensions() + 1) * largest;
  }
  return u;
}

}  // namespace

bool LeafSearch::is_worth_trying(const Master& master, double cutoff) const {
  if (limits_.max_work == 0 || master.live().size() > kMostLeafArcs) return false;
  const double gap = cutoff - master.lower();
  return gap <= kShrunk * failed_gap_ ||
         master.lower() - failed_lower_ >= (1 - kShrunk) * failed_budget_ ||
         credit_ >= kMoreCredit * failed_work_;
}

bool LeafSearch::operator()(const Master& master, double& cutoff) {
  credit_ += limits_.max_work +
             work_of_pivots(master.simplex_iterations() - pivots_, component_.num_slots());
  pivots_ = master.simplex_iterations();
  if (!is_worth_trying(master, cutoff) || limits_.deadline.reached()) return false;
  if (search_slack(master, cutoff) || cover(master, cutoff)) return true;
  failed_gap_ = cutoff - master.lower();
  failed_lower_ = master.lower();
  failed_work_ = credit_;
  credit_ = 0;
  return false;
}

bool LeafSearch::search_slack(const Master& master, double& cutoff) {
  const MasterSlack slack(component_, master);
  const double gap = cutoff - slack.base();
  bnb::SlackLimits limits;
  limits.deadline = limits_.deadline;
  limits.for_all = limits_.for_all;
  limits.step = limits_.step;
  const double few = kFewIndices / static_cast<double>(component_.num_indices());
  double budget = kFirstShare * gap > 0 ? kFirstShare * gap : gap;
  for (double work = 0;; budget *= 2) {
    failed_budget_ = budget = std::min(gap, budget);
    limits.max_work = credit_ * std::min(1.0, few * std::sqrt(budget / gap)) - work;
    limits.max_nodes = limits_.max_nodes - nodes_;
    const std::vector<ArcId> arcs = slack.affordable(budget);
    if (few < 1 && arcs.size() > component_.num_indices()) return false;
    const LeafFinds found = list(slack.problem(arcs), budget, limits);
    nodes_ += found.nodes;
    work += found.work;
    work_ += found.work;
    fixing_ += found.fixing;
    for (const std::vector<std::uint32_t>& packing : found.packings)
      lower(master, core::make_packing(component_, core::at_positions(arcs, packing)), cutoff);
    if (!found.complete) return false;
    if (budget < std::min(gap, cutoff - slack.base())) continue;
    if (limits_.proof != nullptr)
      limits_.proof->search(slack.u(), cutoff, proof_cuts(master.cuts()));
    return true;
  }
}

LeafFinds LeafSearch::list(const bnb::SlackProblem& problem,
                           double budget,
                           const bnb::SlackLimits& limits) {
  if (limits_.ranks != nullptr) return limits_.ranks->list(problem, budget, limits);
  bnb::SlackResult best = bnb::search_slack(problem, budget, limits);
  LeafFinds found{{}, best.complete, best.nodes, best.work, best.fixing};
  if (best.slack < kInfinity) found.packings.push_back(std::move(best.arcs));
  return found;
}

// Offers a packing, if it is cheaper than the cutoff.
void LeafSearch::lower(const Master& master, const core::Packing& packing, double& cutoff) const {
  if (packing.cost < cutoff) cutoff = offer_(master, &packing);
}

bool LeafSearch::cover(const Master& master, double& cutoff) {
  if (master.live().size() > bnb::kMostCliqueArcs) return false;
  if (limits_.ranks != nullptr && !limits_.ranks->may_cover) return false;
  if (clique_pause_ == nullptr) return search_cliques(master, cutoff);
  if (clique_pause_->skip()) return false;
  const bool ended = search_cliques(master, cutoff);
  clique_pause_->note(ended);
  return ended;
}

bool LeafSearch::search_cliques(const Master& master, double& cutoff) {
  if (limits_.ranks != nullptr) return rank_cliques(master, cutoff);
  const std::vector<double> u = demands(component_, master);
  const bnb::SearchResult result =
      bnb::cover(component_, allowed(master), u, cutoff, clique_limits());
  nodes_ += result.nodes;
  work_ += result.work;
  if (result.found) lower(master, result.best, cutoff);
  if (!result.complete || result.lower < cutoff) return false;
  if (limits_.proof != nullptr) limits_.proof->cliques(u, cutoff);
  return true;
}

// Every arc counts here.  What leaves a slot alone that must be covered would be listed in the
// place of others, if covering it did not pay for more than the least cost is below the cutoff.
bool LeafSearch::rank_cliques(const Master& master, double& cutoff) {
  const double demand = 2 * (cutoff - limits_.ranks->least);
  const auto demand_of = [&](std::uint32_t slot) { return master.forced(slot) ? demand : 0.0; };
  double target = -cutoff;
  for (std::uint32_t slot = 0; slot < component_.num_slots(); ++slot) target += demand_of(slot);
  const std::vector<ArcId> arcs = allowed(master);
  bnb::CliqueProblem problem;
  std::vector<std::uint32_t> slots;
  for (const ArcId a : arcs) {
    slots.clear();
    double gain = -component_.costs[a];
    core::for_each_slot(component_, a, [&](std::uint32_t slot) {
      slots.push_back(slot);
      gain += demand_of(slot);
    });
    problem.add_arc(gain, slots);
  }
  const bnb::CliqueRanking found =
      bnb::rank_cliques(problem, limits_.ranks->k, target, 0, clique_limits());
  nodes_ += found.nodes;
  work_ += found.work;
  for (const bnb::CliquePacking& packing : found.packings)
    lower(master, core::make_packing(component_, core::at_positions(arcs, packing.arcs)), cutoff);
  return found.complete;
}

bnb::CliqueLimits LeafSearch::clique_limits() const {
  return {limits_.max_nodes - nodes_, credit_, limits_.deadline};
}

}  // namespace nda::cutting
