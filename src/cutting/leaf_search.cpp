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
constexpr double kFirstShare = 0.125;  // of the gap
// Over many indices a search whose budget is a small part of the gap may only take a part of the
// credit: what fails early would have failed late.  With more arcs than indices it fails anyway.
constexpr double kFewIndices = 4000;
// In dense components what a search takes grows with a high power of the number of arcs that its
// budget pays for.  So that is what grows from one budget to the next.
constexpr double kFirstArcsPerIndex = 1.5;
constexpr double kMoreArcs = 1.25;
constexpr double kLeastWider = 1.25;  // times the budget before
constexpr std::size_t kMostArcsPerIndex = 20;
constexpr double kSame = 1e-6;  // of the gap: reduced costs that differ by less are the same

// The budgets of searches within a gap, from small to large.
class Budgets {
 public:
  Budgets(const core::Component& component, const MasterSlack& slack, double gap, bool is_dense)
      : gap_(gap), num_indices_(static_cast<double>(component.num_indices())) {
    if (!is_dense) return;
    for (const ArcId a : slack.affordable(gap)) reduced_.push_back(slack.reduced(a));
    const std::size_t most = kMostArcsPerIndex * component.num_indices();
    if (reduced_.size() > most) {
      std::ranges::nth_element(reduced_, reduced_.begin() + static_cast<std::ptrdiff_t>(most));
      reduced_.resize(most);
    }
    std::ranges::sort(reduced_);
  }

  double first() const {
    const double part = kFirstShare * gap_;
    if (!(part > 0 && part < kInfinity)) return gap_;
    return std::min(part, paying_for(kFirstArcsPerIndex * num_indices_));
  }

  double after(double budget) const {
    const auto end = std::ranges::lower_bound(reduced_, budget);
    const double wider = paying_for(kMoreArcs * static_cast<double>(end - reduced_.begin()));
    return std::min(gap_, wider < kInfinity ? std::max(kLeastWider * budget, wider) : 2 * budget);
  }

 private:
  // The least that pays for so many arcs and all that cost the same; infinite where no arc costs
  // more.
  double paying_for(double num_arcs) const {
    if (num_arcs >= static_cast<double>(reduced_.size())) return kInfinity;
    const double last = reduced_[static_cast<std::size_t>(num_arcs)];
    const auto dearer = std::ranges::upper_bound(reduced_, last + kSame * gap_);
    return dearer == reduced_.end() ? kInfinity : *dearer;
  }

  const double gap_;
  const double num_indices_;
  std::vector<double> reduced_;  // ascending
};

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
         credit_ >= 2 * failed_work_;
}

bool LeafSearch::operator()(const Master& master, double& cutoff) {
  credit_ += limits_.max_work +
             work_of_pivots(master.simplex_iterations() - pivots_, component_.num_slots());
  pivots_ = master.simplex_iterations();
  if (!is_worth_trying(master, cutoff) || limits_.context.deadline.reached()) return false;
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
  limits.deadline = limits_.context.deadline;
  limits.for_all = limits_.context.for_all;
  limits.step = limits_.context.step;
  const double few = kFewIndices / static_cast<double>(component_.num_indices());
  const Budgets budgets(component_, slack, gap, limits_.context.is_dense);
  double seen = -kInfinity;  // what has less slack is known
  double budget = budgets.first();
  for (double work = 0; seen < std::min(gap, cutoff - slack.base());
       budget = budgets.after(budget)) {
    failed_budget_ = budget;
    limits.max_work = credit_ * std::min(1.0, few * std::sqrt(budget / gap)) - work;
    limits.max_nodes = limits_.max_nodes - nodes_;
    const std::vector<ArcId> arcs = slack.affordable(budget);
    if (few < 1 && arcs.size() > component_.num_indices()) return false;
    const LeafFinds found = list(slack.problem(arcs), budget, limits);
    nodes_ += found.nodes;
    work += found.work;
    work_ += found.work;
    fixing_ += found.fixing;
    for (std::size_t n = 0; n < found.packings.size(); ++n) {
      if (n > 0 && limits_.context.deadline.reached()) return false;
      const std::vector<ArcId> packing = core::at_positions(arcs, found.packings[n]);
      lower(master, core::make_packing(component_, packing), cutoff);
    }
    if (found.complete) seen = budget;
    // Even a search that was cut short may have found what the one before it is enough for.
    const bool is_enough = limits_.ranks == nullptr && seen >= cutoff - slack.base();
    if (!found.complete && !is_enough) return false;
  }
  if (limits_.context.proof != nullptr)
    limits_.context.proof->search(slack.u(), cutoff, proof_cuts(master.cuts()));
  return true;
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
  if (limits_.context.proof != nullptr) limits_.context.proof->cliques(u, cutoff);
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
  for (const bnb::CliquePacking& packing : found.packings) {
    if (limits_.context.deadline.reached()) return false;
    lower(master, core::make_packing(component_, core::at_positions(arcs, packing.arcs)), cutoff);
  }
  return found.complete;
}

bnb::CliqueLimits LeafSearch::clique_limits() const {
  return {limits_.max_nodes - nodes_, credit_, limits_.context.deadline};
}

}  // namespace nda::cutting
