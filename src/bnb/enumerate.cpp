#include "bnb/enumerate.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/slices.hpp"

// The report (4.7) leaves small components to branch and bound.  Here that is the search of
// slack_search.cpp without any cuts: the multipliers alone are its relaxation.

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;

// The arcs that the budget pays for go into the problem; returns their numbers.
std::vector<ArcId> add_affordable(const Component& component,
                                  std::span<const double> u,
                                  double budget,
                                  const core::Deadline& deadline,
                                  SlackProblem& problem) {
  std::vector<ArcId> arcs;
  std::vector<RowUse> uses;
  core::for_each_until(deadline, component.num_arcs(), [&](std::size_t i) {
    const auto a = static_cast<ArcId>(i);
    const double reduced = std::max(0.0, core::reduced_cost(component, u, a));
    if (!(reduced < budget)) return;
    uses.clear();
    core::for_each_slot(component, a, [&](std::uint32_t slot) { uses.push_back({slot, 1}); });
    problem.add_arc(reduced, uses);
    arcs.push_back(a);
  });
  return arcs;
}

}  // namespace

SearchResult enumerate(const Component& component,
                       std::span<const double> u,
                       double cutoff,
                       std::int64_t max_nodes,
                       const core::Deadline& deadline) {
  SearchResult result;
  const double lower = std::accumulate(u.begin(), u.end(), 0.0);
  result.lower = std::min(lower, cutoff);
  SlackProblem problem(static_cast<std::uint32_t>(component.num_slots()));
  for (const double multiplier : u) problem.add_row(std::max(0.0, -multiplier));
  const std::vector<ArcId> arcs = add_affordable(component, u, cutoff - lower, deadline, problem);
  if (deadline.reached()) return result;
  SlackLimits limits;
  limits.max_nodes = max_nodes;
  limits.deadline = deadline;
  const SlackResult found = search_slack(problem, cutoff - lower, limits);
  result.nodes = found.nodes;
  result.complete = found.complete;
  if (found.slack < kInfinity) {
    std::vector<ArcId> chosen;
    for (const std::uint32_t n : found.arcs) chosen.push_back(arcs[n]);
    result.best = core::make_packing(component, std::move(chosen));
    result.found = result.best.cost < cutoff;
  }
  if (result.complete) result.lower = result.found ? std::min(cutoff, result.best.cost) : cutoff;
  return result;
}

}  // namespace nda::bnb
