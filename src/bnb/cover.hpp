#pragma once

#include <span>

#include "bnb/clique_search.hpp"
#include "bnb/enumerate.hpp"
#include "core/component.hpp"

namespace nda::bnb {

/// The best packing of these arcs that is cheaper than `cutoff`, by covers by cliques
/// (search_cliques): arcs count by what they gain over u, so a packing costs
///
///     at least sum u - sum over its arcs of gain,
///
/// and no more if it covers all slots with u > 0.
///
/// Unlike those of enumerate(), best.cost may miss the cutoff where the packing found leaves such a
/// slot uncovered.
///
/// @param arcs  those that may be used, ascending.
/// @param u     by slot, >= 0: more than covering the slot can cost where it must be covered, else
///              0.
SearchResult cover(const core::Component& component,
                   std::span<const core::ArcId> arcs,
                   std::span<const double> u,
                   double cutoff,
                   const CliqueLimits& limits);

}  // namespace nda::bnb
