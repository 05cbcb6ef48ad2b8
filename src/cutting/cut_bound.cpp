#include "cutting/cut_bound.hpp"

#include "core/double_double.hpp"

namespace nda::cutting {

using core::ArcId;

double price(const core::Component& component,
             std::span<const ArcId> arcs,
             std::span<const double> u,
             std::span<const CutRow> cuts,
             std::span<const std::uint16_t> forbidden,
             std::span<double> reduced) {
  for (const ArcId a : arcs) reduced[a] = core::reduced_cost(component, u, a);
  core::DoubleDouble bound;
  for (const double multiplier : u) bound.add(multiplier);
  for (const CutRow& row : cuts) {
    if (row.multiplier == 0) continue;
    bound.add(row.multiplier * row.cut.right_side());
    for (const CutEntry& entry : row.entries) {
      reduced[entry.arc] -= row.multiplier * entry.coefficient;
    }
  }
  for (const ArcId a : arcs) {
    if (reduced[a] < 0 && (forbidden.empty() || forbidden[a] == 0)) bound.add(reduced[a]);
  }
  return bound.high();
}

}  // namespace nda::cutting
