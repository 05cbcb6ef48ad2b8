#pragma once

#include <span>

#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::recovery {

/// Takes arcs in ascending order of `key` (num_arcs() entries) as long as they fit and cost less
/// than nothing; ties by arc number.  key = costs is the plain greedy, key = reduced costs the
/// dual-guided one (docs/state of the art in docs/methods.md: it ranks arcs by what they cost
/// beyond the multipliers).  Empty where the deadline strikes while they are sorted.
/// Cost: O(A log A + A N).
core::Packing greedy(const core::Component& component,
                     std::span<const double> key,
                     const core::Deadline& deadline = {});

/// The same among some arcs, none of them twice, key[n] for arcs[n].
core::Packing greedy(const core::Component& component,
                     std::span<const core::ArcId> arcs,
                     std::span<const double> key);

/// Of a cost, added to a reduced cost that is a key: of equal reduced costs (multipliers make
/// thousands of zeros) the cheaper arc comes first.
inline constexpr double kTieBreak = 1e-6;

/// Dual-guided greedy: key[a] = c'[a] - sum of u over its slots.
core::Packing dual_greedy(const core::Component& component,
                          std::span<const double> u,
                          const core::Deadline& deadline = {});

/// Rounds a relaxed point: takes arcs[k] in descending order of values[k] > 0 as long as they fit,
/// the cheaper ones first where values are equal.
core::Packing round_values(const core::Component& component,
                           std::span<const core::ArcId> arcs,
                           std::span<const double> values);

}  // namespace nda::recovery
