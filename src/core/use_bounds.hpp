#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "nda/problem.hpp"

namespace nda::core {

// Bounds on the uses of an index (docs/many_to_one.md).

/// How often the singleton of an index is chosen beside `num_arcs` arcs that use it: as rarely as
/// `bounds` allow, or as often where it pays.  Nothing where the bounds cannot be kept: too many
/// arcs, or too few and the singleton is forbidden.
/// @param cost  of the singleton; +inf forbids it, below 0 only where hi is limited.
inline std::optional<std::size_t> singleton_uses(UseBounds bounds,
                                                 double cost,
                                                 std::size_t num_arcs) {
  const bool is_limited = bounds.hi != UseBounds::kUnlimited;
  if (is_limited && num_arcs > bounds.hi) return std::nullopt;
  if (cost < 0) return bounds.hi - num_arcs;
  const std::size_t missing = num_arcs < bounds.lo ? bounds.lo - num_arcs : 0;
  if (missing > 0 && cost == kInfinity) return std::nullopt;
  return missing;
}

/// "1..2", "0..inf".
std::string bounds_text(UseBounds bounds);

/// "index 3 of dimension 1 has bounds 0..2" for the first index with bounds other than 1..1; empty
/// when there is none.
std::string first_bounds(const Problem& problem);

/// Throws InputError "<who> cannot deal with bounds on uses: index 3 of dimension 1 has bounds
/// 0..2" where any index has bounds other than 1..1.
/// @param who  what asks that every index be used exactly once.
void require_single_uses(const Problem& problem, const std::string& who);

}  // namespace nda::core
