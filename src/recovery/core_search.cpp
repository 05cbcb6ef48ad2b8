#include "recovery/core_search.hpp"

#include <algorithm>

#include "recovery/greedy.hpp"
#include "recovery/local_search.hpp"

// Good packings live where reduced costs are small.  Cutting the few promising arcs out first makes
// every move of the local search independent of the size of the component: lists are short and
// memory stays in cache.

namespace nda::recovery {

using core::ArcId;
using core::Component;
using core::Packing;

std::vector<ArcId> core_arcs(const Component& component,
                             std::span<const double> u,
                             double gap,
                             std::size_t arcs_per_index,
                             std::span<const ArcId> keep) {
  std::vector<std::pair<double, ArcId>> ranked;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const double r = core::reduced_cost(component, u, a);
    if (r < gap) ranked.push_back({r, a});
  }
  const std::size_t limit = arcs_per_index * component.num_indices();
  if (ranked.size() > limit) {
    std::nth_element(
        ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(limit), ranked.end());
    ranked.resize(limit);
  }
  std::vector<ArcId> arcs(keep.begin(), keep.end());
  for (const auto& entry : ranked) arcs.push_back(entry.second);
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  return arcs;
}

Packing search_core(const Component& component,
                    std::span<const double> u,
                    double gap,
                    const Packing& start,
                    const CoreSearchOptions& options,
                    core::Random& random,
                    const core::Deadline& deadline) {
  const std::vector<ArcId> arcs = core_arcs(component, u, gap, options.arcs_per_index, start.arcs);
  core::Cutter cutter;
  const Component core = cutter.cut(component, arcs);
  const std::vector<double> core_u = core::restrict_slots(component, u, core);
  Packing packing = start;
  for (ArcId& a : packing.arcs) {
    a = static_cast<ArcId>(std::lower_bound(arcs.begin(), arcs.end(), a) - arcs.begin());
  }
  if (packing.arcs.empty()) packing = dual_greedy(core, core_u);
  const std::size_t size = std::min(core.num_indices(), core.num_arcs());
  const std::int64_t kicks =
      std::int64_t{options.kicks_per_index} * static_cast<std::int64_t>(size);
  LocalSearch(core, core_u).improve(packing, kicks, options.goal, random, deadline);
  if (packing.cost >= start.cost) return start;
  for (ArcId& a : packing.arcs) a = arcs[a];
  return packing;
}

}  // namespace nda::recovery
