#include "bnb/component_gains.hpp"

#include <numeric>

namespace nda::bnb {

using core::ArcId;

ComponentGains gains_over(const core::Component& component,
                          std::span<const ArcId> arcs,
                          std::span<const double> u) {
  ComponentGains gains;
  gains.base = std::accumulate(u.begin(), u.end(), 0.0);
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

}  // namespace nda::bnb
