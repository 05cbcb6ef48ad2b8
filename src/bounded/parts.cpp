#include "bounded/parts.hpp"

#include <algorithm>

#include "core/double_double.hpp"
#include "decompose/components.hpp"

namespace nda::bounded {

using core::ArcId;

std::vector<BoundedComponent> cut_parts(const BoundedComponent& whole,
                                        const core::Deadline& deadline,
                                        bool decompose) {
  std::vector<BoundedComponent> parts;
  decompose::Partition partition = decompose::partition(whole.graph, deadline);
  if (!decompose) decompose::join(partition);
  core::Cutter cutter;
  for (std::size_t c = 0; c < partition.num_components() && !deadline.reached(); ++c) {
    parts.push_back(cut_arcs(whole, partition.component(c), cutter));
  }
  return parts;
}

BoundedComponent cut_arcs(const BoundedComponent& whole,
                          std::span<const ArcId> arcs,
                          core::Cutter& cutter) {
  BoundedComponent part{cutter.cut(whole.graph, arcs), {}};
  part.graph.arc_origin.assign(arcs.begin(), arcs.end());
  part.rows.resize(part.graph.num_slots());
  const std::vector<std::uint32_t> slots = core::slots_in_part(whole.graph, part.graph);
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    if (slots[slot] != 0) part.rows[slots[slot]] = whole.rows[slot];
  }
  fit_rows(part);
  return part;
}

double cost_without_arcs(const BoundedComponent& whole) {
  const std::vector<Index> degree = count_uses(whole.graph, core::all_arcs(whole.graph));
  core::DoubleDouble cost;
  for (std::size_t slot = 0; slot < degree.size(); ++slot) {
    if (degree[slot] == 0) cost.add(whole.rows[slot].cost(0));
  }
  return cost.high();
}

void fit_rows(BoundedComponent& component) {
  const std::vector<Index> degree = count_uses(component.graph, core::all_arcs(component.graph));
  for (std::size_t slot = 0; slot < degree.size(); ++slot) {
    Row& row = component.rows[slot];
    row.is_open = row.is_open || row.hi >= degree[slot];
    row.hi = std::max(row.lo, std::min(row.hi, degree[slot]));
  }
}

}  // namespace nda::bounded
