#include "recovery/combine.hpp"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/find_set.hpp"

namespace nda::recovery {

using core::ArcId;
using core::Packing;

Packing combine(const core::Component& component, const Packing& first, const Packing& second) {
  std::vector<std::uint32_t> parent(component.num_slots());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto cluster = [&](ArcId a) {
    std::uint32_t slot = 0;
    core::for_each_slot(component, a, [&](std::uint32_t s) { slot = s; });
    return core::find_set(parent, slot);
  };
  for (const Packing* packing : {&first, &second}) {
    for (const ArcId a : packing->arcs)
      core::for_each_slot(
          component, a, [&](std::uint32_t s) { parent[core::find_set(parent, s)] = cluster(a); });
  }
  std::vector<double> saved(component.num_slots(), 0.0);
  for (const ArcId a : first.arcs) saved[cluster(a)] += component.costs[a];
  for (const ArcId a : second.arcs) saved[cluster(a)] -= component.costs[a];
  std::vector<ArcId> arcs;
  for (const ArcId a : first.arcs) {
    if (!(saved[cluster(a)] > 0)) arcs.push_back(a);
  }
  for (const ArcId a : second.arcs) {
    if (saved[cluster(a)] > 0) arcs.push_back(a);
  }
  return core::make_packing(component, std::move(arcs));
}

}  // namespace nda::recovery
