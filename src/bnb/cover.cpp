#include "bnb/cover.hpp"

#include <numeric>
#include <vector>

namespace nda::bnb {
namespace {

using core::ArcId;

struct Gains {
  CliqueProblem problem;
  std::vector<ArcId> arcs;  // [arc of the problem]; those that gain nothing are left out
};

Gains gains_over(const core::Component& component,
                 std::span<const ArcId> arcs,
                 std::span<const double> u) {
  Gains gains;
  std::vector<std::uint32_t> slots;
  for (const ArcId a : arcs) {
    slots.clear();
    double gain = -component.costs[a];
    core::for_each_slot(component, a, [&](std::uint32_t slot) {
      slots.push_back(slot);
      gain += u[slot];
    });
    if (!(gain > 0)) continue;
    gains.arcs.push_back(a);
    gains.problem.add_arc(gain, slots);
  }
  return gains;
}

}  // namespace

SearchResult cover(const core::Component& component,
                   std::span<const ArcId> arcs,
                   std::span<const double> u,
                   double cutoff,
                   const CliqueLimits& limits) {
  const Gains gains = gains_over(component, arcs, u);
  const double base = std::accumulate(u.begin(), u.end(), 0.0);
  const CliqueResult found = search_cliques(gains.problem, base - cutoff, limits);
  SearchResult result;
  result.nodes = found.nodes;
  result.work = found.work;
  result.complete = found.complete;
  if (found.complete) result.lower = base - found.most;
  result.found = !found.arcs.empty();
  if (result.found)
    result.best = core::make_packing(component, core::at_positions(gains.arcs, found.arcs));
  return result;
}

}  // namespace nda::bnb
