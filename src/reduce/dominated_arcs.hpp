#pragma once

#include <cstddef>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// Drops every arc that disjoint arcs within its indices replace at no greater cost, and of arcs
/// with the same indices all but the cheapest.  Arcs of more than kMostDominatedIndices indices
/// stay.  Returns how many it dropped.
/// Cost: O(A 2^N) looks into a table, each a nanosecond or two; nothing where no arc is shorter
/// than others.
std::size_t drop_dominated_arcs(ArcPool& pool);

inline constexpr std::size_t kMostDominatedIndices = 8;

}  // namespace nda::reduce
