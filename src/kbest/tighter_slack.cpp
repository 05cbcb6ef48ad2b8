#include "kbest/tighter_slack.hpp"

#include <utility>
#include <vector>

#include "cutting/cut_loop.hpp"
#include "cutting/master.hpp"
#include "cutting/master_slack.hpp"

// The linear program is about the slack itself, from which the multipliers known already are no
// step away: a row of finite price may stay unused at that price, as if its arcs refunded it, and
// one of infinite price must be used, so its multiplier may have either sign.  Costs of that size
// keep their digits, which a penalty for what must be used would take.

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr double kWorthwhile = 0.01;  // share of the slack that a round takes away

// Every arc refunds the prices of what it uses.
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

// What the refunds make of the multipliers that there were.
std::vector<double> multipliers_of(const bnb::SlackProblem& slack) {
  std::vector<double> u;
  for (std::uint32_t row = 0; row < slack.num_indices(); ++row)
    u.push_back(slack.price(row) < kInfinity ? -slack.price(row) : 0);
  return u;
}

}  // namespace

std::optional<bnb::ComponentSlack> tighter_slack(const core::Component& component,
                                                 const bnb::SlackProblem& slack,
                                                 std::span<const ArcId> best,
                                                 double reach,
                                                 int max_rounds,
                                                 const core::Deadline& deadline) {
  const core::Component refunding = with_refunds(component, slack);
  cutting::Master master(refunding, core::all_arcs(refunding), multipliers_of(slack));
  for (std::uint32_t row = 0; row < slack.num_indices(); ++row) {
    if (slack.price(row) == kInfinity) master.force(row);
  }
  const double cost = core::make_packing(refunding, {best.begin(), best.end()}).cost;
  cutting::CutLoopOptions loop;
  loop.cutoff = cost + reach;
  loop.max_rounds = max_rounds;
  loop.worthwhile = kWorthwhile;
  loop.deadline = deadline;
  // What leaves the best packing no slack cannot be improved.
  const auto cutoff = [&](const cutting::Master& point) {
    return point.lower() < cost ? cost + reach : point.lower();
  };
  const cutting::CutLoopEnd end = cutting::run_cut_loop(refunding, master, loop, cutoff);
  if (end == cutting::CutLoopEnd::kStopped) return std::nullopt;
  const cutting::MasterSlack tighter(refunding, master);
  std::vector<ArcId> arcs = tighter.affordable(kInfinity);
  bnb::SlackProblem problem = tighter.problem(arcs);
  return bnb::ComponentSlack{std::move(problem), std::move(arcs)};
}

}  // namespace nda::kbest
