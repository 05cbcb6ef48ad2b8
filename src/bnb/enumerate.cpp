#include "bnb/enumerate.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "bnb/component_slack.hpp"
#include "bnb/slack_search.hpp"

// The report (4.7) leaves small components to branch and bound.  Here that is the search of
// slack_search.cpp without any cuts: the multipliers alone are its relaxation.

namespace nda::bnb {
SearchResult enumerate(const core::Component& component,
                       std::span<const double> u,
                       double cutoff,
                       std::int64_t max_nodes,
                       const core::Deadline& deadline) {
  SearchResult result;
  const double lower = std::accumulate(u.begin(), u.end(), 0.0);
  result.lower = std::min(lower, cutoff);
  const ComponentSlack slack = slack_of(component, u, cutoff - lower, deadline);
  if (deadline.reached()) return result;
  SlackLimits limits;
  limits.max_nodes = max_nodes;
  limits.deadline = deadline;
  const SlackResult found = search_slack(slack.problem, cutoff - lower, limits);
  result.nodes = found.nodes;
  result.searches = found.fixing;
  result.complete = found.complete;
  if (found.slack < kInfinity) {
    result.best = core::make_packing(component, core::at_positions(slack.arcs, found.arcs));
    result.found = result.best.cost < cutoff;
  }
  if (result.complete) result.lower = result.found ? std::min(cutoff, result.best.cost) : cutoff;
  return result;
}

}  // namespace nda::bnb
