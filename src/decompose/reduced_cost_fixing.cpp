#include "decompose/reduced_cost_fixing.hpp"

#include <algorithm>
#include <utility>

#include "core/reduced_costs.hpp"

// Every solution costs sum u + sum of r over its arcs + sum of -u over its uncovered indices, and
// all terms but the first are >= 0.  So lower + r[a] bounds what a costs at least, and lower - u_i
// what leaving i uncovered costs at least.  The second rule looks at one index: exactly one of its
// uses happens.

namespace nda::decompose {
namespace {

using core::ArcId;
using core::Component;

// The cheapest and second cheapest use of an index; leaving it uncovered is one of them.
struct Uses {
  double best;
  double second;
  ArcId arc;
};

constexpr ArcId kUncovered = ~ArcId{0};

void note(Uses& uses, double r, ArcId a) {
  if (r < uses.best) {
    uses = {r, uses.best, a};
  } else {
    uses.second = std::min(uses.second, r);
  }
}

std::vector<Uses> cheapest_uses(const Component& component,
                                std::span<const double> u,
                                std::span<const ArcId> live) {
  std::vector<Uses> uses;
  uses.reserve(u.size());
  for (const double multiplier : u) uses.push_back({-multiplier, kInfinity, kUncovered});
  for (const ArcId a : live) {
    const double r = core::reduced_cost(component, u, a);
    core::for_each_slot(component, a, [&](std::uint32_t slot) { note(uses[slot], r, a); });
  }
  return uses;
}

}  // namespace

Fixing fix(const Component& component, std::span<const double> u, double lower, double cutoff) {
  Fixing fixing;
  core::for_each_reduced_cost(component, u, {}, [&](ArcId a, double r) {
    if (lower + r < cutoff) fixing.live.push_back(a);
  });
  const std::vector<Uses> uses = cheapest_uses(component, u, fixing.live);
  std::vector<std::pair<ArcId, std::uint32_t>> taken;
  std::vector<bool> covered(component.num_slots(), false);
  for (std::uint32_t slot = 0; slot < component.num_slots(); ++slot) {
    const Uses& use = uses[slot];
    if (use.arc == kUncovered || lower + use.second < cutoff) continue;
    bool free = true;
    core::for_each_slot(component, use.arc, [&](std::uint32_t s) { free = free && !covered[s]; });
    if (!free) continue;
    taken.emplace_back(use.arc, slot);
    core::for_each_slot(component, use.arc, [&](std::uint32_t s) { covered[s] = true; });
  }
  std::erase_if(fixing.live, [&](ArcId a) {
    bool hit = false;
    core::for_each_slot(component, a, [&](std::uint32_t slot) { hit = hit || covered[slot]; });
    return hit;
  });
  std::sort(taken.begin(), taken.end());
  for (const auto& [arc, slot] : taken) {
    fixing.taken.push_back(arc);
    fixing.forcing.push_back(slot);
  }
  return fixing;
}

}  // namespace nda::decompose
