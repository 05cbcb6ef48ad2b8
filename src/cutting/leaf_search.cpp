#include "cutting/leaf_search.hpp"

#include <algorithm>
#include <vector>

#include "bnb/slack_search.hpp"
#include "cutting/master_slack.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;

constexpr double kShrunk = 0.75;
constexpr double kFirstShare = 0.125;  // of the gap

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
  if (!is_worth_trying(master, cutoff) || limits_.deadline.reached()) return false;
  const MasterSlack slack(component_, master);
  const double gap = cutoff - slack.base();
  bnb::SlackLimits limits;
  limits.deadline = limits_.deadline;
  double budget = kFirstShare * gap > 0 ? kFirstShare * gap : gap;
  for (double work = 0;; budget *= 2) {
    budget = std::min(gap, budget);
    limits.max_work = credit_ - work;
    limits.max_nodes = limits_.max_nodes - nodes_;
    const std::vector<ArcId> arcs = slack.affordable(budget);
    const bnb::SlackResult result = bnb::search_slack(slack.problem(arcs), budget, limits);
    nodes_ += result.nodes;
    work += result.work;
    if (result.slack < kInfinity) {
      const core::Packing packing =
          core::make_packing(component_, core::at_positions(arcs, result.arcs));
      if (packing.cost < cutoff) cutoff = offer_(master, &packing);
    }
    if (!result.complete) break;
    if (!(result.slack < budget) && budget < gap) continue;
    if (limits_.proof != nullptr) limits_.proof->search(master, slack.u(), cutoff);
    return true;
  }
  failed_gap_ = gap;
  failed_budget_ = budget;
  failed_lower_ = master.lower();
  failed_work_ = credit_;
  credit_ = 0;
  return false;
}

}  // namespace nda::cutting
