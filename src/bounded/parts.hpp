#pragma once

#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "core/clock.hpp"

namespace nda::bounded {

/// A component that may fall apart, in connected components (4.7); arc_origin of each are arcs of
/// the whole.  Indices without arcs are in none.  Where the deadline strikes, none, or some are
/// missing.
/// @param decompose  false: one component of all that have arcs
std::vector<BoundedComponent> cut_parts(const BoundedComponent& whole,
                                        const core::Deadline& deadline,
                                        bool decompose = true);

/// These arcs of a component, ascending, and the indices they use; arc_origin are the arcs.
BoundedComponent cut_arcs(const BoundedComponent& whole,
                          std::span<const core::ArcId> arcs,
                          core::Cutter& cutter);

/// What all indices without arcs cost.
double cost_without_arcs(const BoundedComponent& whole);

/// Makes the rows those of the arcs that are there: no index is used more often than it has arcs,
/// but where even that is less than `lo`.
void fit_rows(BoundedComponent& component);

}  // namespace nda::bounded
