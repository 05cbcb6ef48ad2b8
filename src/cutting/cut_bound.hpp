#pragma once

#include <cstdint>
#include <span>

#include "core/component.hpp"
#include "cutting/cut.hpp"

namespace nda::cutting {

/// What multipliers of the indices and of cuts prove about all packings of `arcs` that are not
/// forbidden:
///
///     sum u + sum over cuts of multiplier * right side + sum over those arcs of min(0, r),
///
/// a lower bound whatever the multipliers are, as long as those of the cuts are <= 0, and those of
/// the indices too, but where an index must be covered; summed in double-double.  Writes r = c' -
/// sum of u - sum of multiplier * coefficient to reduced[a] of every arc of `arcs`, forbidden or
/// not.
///
/// @param u          by slot; those of the dummies are 0.
/// @param cuts       with entries for all of `arcs`; others do no harm.
/// @param forbidden  [arc]: more than 0 where it is; empty = none is.
/// Cost: O(arcs N + entries).
double price(const core::Component& component,
             std::span<const core::ArcId> arcs,
             std::span<const double> u,
             std::span<const CutRow> cuts,
             std::span<const std::uint16_t> forbidden,
             std::span<double> reduced);

}  // namespace nda::cutting
