#include "bounded/cells.hpp"

#include <algorithm>

namespace nda::bounded {

using core::ArcId;

Cells find_cells(const core::Component& graph, int num_kept) {
  Cells cells;
  cells.num_kept = num_kept;
  cells.arcs = core::all_arcs(graph);
  const auto compare = [&](ArcId a, ArcId b) {
    for (int k = 0; k < num_kept; ++k) {
      if (graph.index(k, a) != graph.index(k, b))
        return graph.index(k, a) < graph.index(k, b) ? -1 : 1;
    }
    return 0;
  };
  std::stable_sort(
      cells.arcs.begin(), cells.arcs.end(), [&](ArcId a, ArcId b) { return compare(a, b) < 0; });
  for (std::size_t n = 0; n < cells.arcs.size(); ++n) {
    if (n == 0 || compare(cells.arcs[n - 1], cells.arcs[n]) != 0) cells.first.push_back(n);
  }
  cells.first.push_back(cells.arcs.size());
  if (!cells.arcs.empty()) {
    bool is_free = true;
    for (int k = 0; k < num_kept; ++k) is_free = is_free && graph.index(k, cells.arcs.front()) == 0;
    cells.num_free = is_free ? 1 : 0;
  }
  return cells;
}

Index most_uses_of_cell(const BoundedComponent& component, int num_kept, ArcId a) {
  Index most = UseBounds::kUnlimited;
  for (int k = 0; k < num_kept; ++k) {
    if (component.graph.index(k, a) != 0)
      most = std::min(most, component.rows[component.graph.slot(k, a)].hi);
  }
  return most;
}

}  // namespace nda::bounded
