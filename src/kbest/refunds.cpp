#include "kbest/refunds.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

// The linear program is about the slack itself, from which the multipliers known already are no
// step away: a row of finite price may stay unused at that price, as if its arcs refunded it, and
// one of infinite price must be used, so its multiplier may have either sign.  Costs of that size
// keep their digits, which a penalty for what must be used would take.

namespace nda::kbest {

using core::ArcId;

core::Component with_refunds(const core::Component& component, const bnb::SlackProblem& slack) {
  core::Component refunding = component;
  for (ArcId a = 0; a < slack.num_arcs(); ++a) {
    double cost = slack.reduced(a);
    for (const bnb::RowUse use : slack.uses(a))
      cost -= slack.price(use.row) < kInfinity ? slack.price(use.row) : 0;
    refunding.costs[a] = cost;
  }
  return refunding;
}

double empty_slack(const bnb::SlackProblem& slack) {
  double total = 0;
  for (std::uint32_t row = 0; row < slack.num_indices(); ++row)
    total += slack.price(row) < kInfinity ? slack.price(row) : 0;
  return total;
}

double greatest_slack(const bnb::SlackProblem& slack) {
  std::vector<double> dearest(slack.num_rows(), 0.0);
  for (ArcId a = 0; a < slack.num_arcs(); ++a) {
    for (const bnb::RowUse use : slack.uses(a))
      dearest[use.row] = std::max(dearest[use.row], slack.reduced(a));
  }
  return std::accumulate(dearest.begin(), dearest.end(), empty_slack(slack));
}

cutting::Master refunding_master(const core::Component& refunding,
                                 std::vector<ArcId> live,
                                 const bnb::SlackProblem& slack) {
  std::vector<double> u;
  for (std::uint32_t row = 0; row < slack.num_indices(); ++row)
    u.push_back(slack.price(row) < kInfinity ? -slack.price(row) : 0);
  cutting::Master master(refunding, std::move(live), u);
  for (std::uint32_t row = 0; row < slack.num_indices(); ++row) {
    if (slack.price(row) == kInfinity) master.force(row);
  }
  return master;
}

}  // namespace nda::kbest
