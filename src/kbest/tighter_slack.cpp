#include "kbest/tighter_slack.hpp"

#include <utility>
#include <vector>

#include "cutting/cut_loop.hpp"
#include "cutting/master.hpp"
#include "cutting/master_slack.hpp"
#include "kbest/refunds.hpp"

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr double kWorthwhile = 0.01;  // share of the slack that a round takes away

}  // namespace

std::optional<bnb::ComponentSlack> tighter_slack(const core::Component& component,
                                                 const bnb::SlackProblem& slack,
                                                 std::span<const ArcId> best,
                                                 double reach,
                                                 int max_rounds,
                                                 const core::Deadline& deadline) {
  const core::Component refunding = with_refunds(component, slack);
  cutting::Master master = refunding_master(refunding, core::all_arcs(refunding), slack);
  const double cost = core::make_packing(refunding, {best.begin(), best.end()}).cost;
  cutting::CutLoopOptions loop;
  loop.cutoff = cost + reach;
  loop.max_rounds = max_rounds;
  loop.worthwhile = kWorthwhile;
  loop.context.deadline = deadline;
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
