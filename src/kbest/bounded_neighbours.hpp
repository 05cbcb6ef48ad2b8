#pragma once

#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "core/clock.hpp"

namespace nda::kbest {

/// A solution near another one: what it costs more, and the arcs that differ, ascending.
struct BoundedNeighbour {
  double rise;
  std::vector<core::ArcId> changed;
};

/// The neighbours of a solution with bounds on uses, cheapest first: it has one arc less; or one
/// more, for which the cheapest arc leaves every index that is full.  All are solutions and all are
/// different.  Cut short by the deadline.  Cost: O(A N).
std::vector<BoundedNeighbour> bounded_neighbours(const bounded::BoundedComponent& component,
                                                 std::span<const core::ArcId> best,
                                                 const core::Deadline& deadline);

/// The arcs of one of them.
std::vector<core::ArcId> arcs_of(const BoundedNeighbour& neighbour,
                                 std::span<const core::ArcId> best);

}  // namespace nda::kbest
