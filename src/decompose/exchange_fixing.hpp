#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::decompose {

/// What fixing by exchange leaves of a component.
struct ExchangeFixing {
  std::vector<core::ArcId> open;     ///< arcs that a better packing may need, and those of the best
                                     ///< packing that these would replace; ascending
  std::vector<core::ArcId> settled;  ///< arcs of the best packing that some best one keeps
};

/// Fixes arcs by reduced costs against what the best packing so far loses where they are, and not
/// in the whole component: where it is far from the bound in one corner only, the others are
/// settled.
///
/// A place is an arc of `best` with its indices, or an index that it leaves uncovered; it loses r
/// of the arc, or -u of the index.  Places joined by an open arc make one, which loses the sum.  An
/// arc that costs at least what the places that it touches lose, less the tolerance, is excluded:
/// some packing of least cost has none of these, up to the tolerance for each arc.
///
/// @param reduced    reduced costs of all arcs under feasible multipliers u (by slot)
/// @param best       any packing of arcs that cost less than nothing
/// @param tolerance  >= 0
/// Cost: O(A), and O(N) some times over for arcs within the loss of the whole.
ExchangeFixing fix_by_exchange(const core::Component& component,
                               std::span<const double> u,
                               std::span<const double> reduced,
                               const core::Packing& best,
                               double tolerance);

}  // namespace nda::decompose
