#include "bounded/separable_dual.hpp"

#include <algorithm>

namespace nda::bounded {
namespace {

using core::ArcId;

// The part of q that depends on one multiplier; costs ascend.
double part_of(const Row& row, std::span<const double> costs, double u) {
  double value = row.value(u);
  for (const double cost : costs) {
    if (cost >= u) break;
    value += cost - u;
  }
  return value;
}

// Where that is largest.  Its slope is the number of uses that f wants minus the arcs cheaper than
// u: hi below 0, lo between 0 and single, none above.
double best_multiplier(const Row& row, std::span<const double> costs) {
  const auto paying =
      static_cast<Index>(std::lower_bound(costs.begin(), costs.end(), 0.0) - costs.begin());
  const auto between = [&](Index last) {
    const double next = last < costs.size() ? costs[last] : costs[last - 1];
    return costs[last - 1] + (next - costs[last - 1]) / 2;
  };
  if (paying > row.hi) return row.hi == 0 ? costs.front() : between(row.hi);
  if (paying >= row.lo) return 0;
  return std::min(row.single, between(row.lo));
}

}  // namespace

SeparableDual::SeparableDual(const BoundedComponent& component)
    : component_(component),
      arcs_(core::list_by_slot(component.graph, core::all_arcs(component.graph))) {}

double SeparableDual::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::fill(subgradient.begin(), subgradient.end(), 0.0);
  double value = 0;
  for (ArcId a = 0; a < component_.num_arcs(); ++a) {
    const double r = core::reduced_cost(component_.graph, u, a);
    if (r >= 0) continue;
    value += r;
    core::for_each_slot(component_.graph, a, [&](std::uint32_t slot) { subgradient[slot] -= 1.0; });
  }
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    const Row& row = component_.rows[slot];
    value += row.value(u[slot]);
    const auto uses = static_cast<Index>(-subgradient[slot]);
    subgradient[slot] += row.best_uses(u[slot], uses);
  }
  return value;
}

double SeparableDual::ascend(std::size_t block, std::span<double> u) {
  const core::Component& graph = component_.graph;
  double increase = 0;
  for (Index i = 1; i <= graph.sizes[block]; ++i) {
    const std::uint32_t slot = graph.offset[block] + i;
    const double before = u[slot];
    u[slot] = 0;
    cost_.clear();
    for (const ArcId a : arcs_[slot]) cost_.push_back(core::reduced_cost(graph, u, a));
    std::sort(cost_.begin(), cost_.end());
    const Row& row = component_.rows[slot];
    const double best = cost_.empty() ? 0 : best_multiplier(row, cost_);
    const double gain = part_of(row, cost_, best) - part_of(row, cost_, before);
    u[slot] = gain >= 0 ? best : before;
    increase += std::max(0.0, gain);
  }
  return increase;
}

}  // namespace nda::bounded
