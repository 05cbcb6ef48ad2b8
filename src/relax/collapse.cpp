#include "relax/collapse.hpp"

#include <array>

// Nearly all time of the relaxation goes into this loop (report, section 5: "the dominant
// computational part is the evaluation of the relaxed two-dimensional cost coefficients").  Columns
// are read as streams, the multipliers by gathers that stay in cache; with N fixed at compile time
// the inner loop has no branches but the minimum.  The report breaks ties by the lexicographically
// smallest tuple, which is the first arc of the run.

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;

struct Relaxed {
  const Index* index;
  const double* u;
};

// kRelaxed = N - 2 relaxed dimensions; 0 means that the number is only known at run time.
template <int kRelaxed>
void collapse_cells(const Component& component,
                    const Cells& cells,
                    std::span<const Relaxed> relaxed,
                    std::span<double> d,
                    std::span<ArcId> arc) {
  const int num_relaxed = kRelaxed > 0 ? kRelaxed : static_cast<int>(relaxed.size());
  std::array<Relaxed, kMaxDimensions> columns;
  std::copy(relaxed.begin(), relaxed.end(), columns.begin());
  const double* cost = component.costs.data();
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    double best = kInfinity;
    ArcId best_arc = cells.first_arc[cell];
    for (ArcId a = cells.first_arc[cell]; a < cells.first_arc[cell + 1]; ++a) {
      double r = cost[a];
      for (int k = 0; k < num_relaxed; ++k) r -= columns[k].u[columns[k].index[a]];
      if (r < best) {
        best = r;
        best_arc = a;
      }
    }
    d[cell] = best;
    arc[cell] = best_arc;
  }
}

}  // namespace

Cells find_cells(const Component& component) {
  Cells cells;
  const core::Column& row = component.indices[0];
  const core::Column& column = component.indices[1];
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (a > 0 && row[a] == row[a - 1] && column[a] == column[a - 1]) continue;
    cells.first_arc.push_back(a);
    cells.row.push_back(row[a]);
    cells.column.push_back(column[a]);
  }
  cells.first_arc.push_back(static_cast<ArcId>(component.num_arcs()));
  return cells;
}

void collapse(const Component& component,
              const Cells& cells,
              std::span<const double> u,
              std::span<double> d,
              std::span<ArcId> arc) {
  std::array<Relaxed, kMaxDimensions> storage;
  const std::size_t num_relaxed = component.sizes.size() - 2;
  for (std::size_t k = 0; k < num_relaxed; ++k) {
    storage[k] = {component.indices[k + 2].data(), u.data() + component.offset[k + 2]};
  }
  const std::span<const Relaxed> relaxed(storage.data(), num_relaxed);
  switch (num_relaxed) {
    case 1:
      return collapse_cells<1>(component, cells, relaxed, d, arc);
    case 2:
      return collapse_cells<2>(component, cells, relaxed, d, arc);
    case 3:
      return collapse_cells<3>(component, cells, relaxed, d, arc);
    case 4:
      return collapse_cells<4>(component, cells, relaxed, d, arc);
    case 5:
      return collapse_cells<5>(component, cells, relaxed, d, arc);
    case 6:
      return collapse_cells<6>(component, cells, relaxed, d, arc);
    default:
      return collapse_cells<0>(component, cells, relaxed, d, arc);
  }
}

}  // namespace nda::relax
