#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"

namespace nda::bounded {

/// The arcs of a component by their first m indices, the kept ones: those that agree are a *cell*.
struct Cells {
  int num_kept = 0;                ///< m
  std::vector<core::ArcId> arcs;   ///< cell after cell, (0 .. 0) first; ascending within
  std::vector<std::size_t> first;  ///< where each begins, and the end
  std::size_t num_free = 0;        ///< cells (0 .. 0): 1 or 0

  std::size_t num_cells() const { return first.size() - 1; }
  std::span<const core::ArcId> operator[](std::size_t cell) const {
    return std::span(arcs).subspan(first[cell], first[cell + 1] - first[cell]);
  }
};

/// @param num_kept  in 0 .. N.  Cost: O(A N log A).
Cells find_cells(const core::Component& graph, int num_kept);

/// How often an arc's cell may be used: as often as all of its kept indices; UseBounds::kUnlimited
/// of cell (0 .. 0).
Index most_uses_of_cell(const BoundedComponent& component, int num_kept, core::ArcId a);

}  // namespace nda::bounded
