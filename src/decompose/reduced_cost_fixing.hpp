#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::decompose {

/// What reduced-cost fixing leaves of a component.
struct Fixing {
  std::vector<core::ArcId> live;       ///< arcs that a better solution may still use, ascending
  std::vector<core::ArcId> taken;      ///< arcs that every better solution uses (not in live)
  std::vector<std::uint32_t> forcing;  ///< [taken]: its slot i below
};

/// Fixes arcs by reduced cost.  u: multipliers by slot, u <= 0, with r[a] = c'[a] - sum of u >= 0
/// for every arc; lower = sum of u.  Looking for solutions of cost < cutoff:
///   - an arc with lower + r[a] >= cutoff is dropped;
///   - an arc is taken when, for one of its indices i, every other use of i is too dear:
///     lower + min(-u_i, r of the other live arcs on i) >= cutoff.  Its rivals are dropped with it.
/// Cost O(A N).  Standard Lagrangian fixing, see docs/mathematics.md.
Fixing fix(const core::Component& component,
           std::span<const double> u,
           double lower,
           double cutoff);

}  // namespace nda::decompose
