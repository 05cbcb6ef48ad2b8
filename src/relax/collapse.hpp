#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::relax {

/// The cells of a component: runs of arcs that agree in their first two indices (i1, i2).
/// Arcs are in lexicographic order, so a cell is a range of arcs and cells are sorted too.
struct Cells {
  std::vector<core::ArcId> first_arc;  ///< of every cell, and num_arcs at the end
  std::vector<Index> row;              ///< i1
  std::vector<Index> column;           ///< i2

  std::size_t num_cells() const { return row.size(); }
};

Cells find_cells(const core::Component& component);

/// The collapse to two dimensions, eq. (3.3) with the sign of u turned: for every cell
///
///     d[cell] = min over its arcs of  c'[a] - sum over k >= 2 of u[slot(k, a)],     arc[cell] =
///     the first that attains it.
///
/// u has num_slots() entries (those of dimensions 0 and 1 are ignored), the dummies' are 0.
/// The kernel is compiled for each N from 3 to 8 (measured two to three times faster than a
/// run-time N). Cost: O(A N); no allocation.
void collapse(const core::Component& component,
              const Cells& cells,
              std::span<const double> u,
              std::span<double> d,
              std::span<core::ArcId> arc);

}  // namespace nda::relax
