#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/for_all.hpp"
#include "core/random.hpp"

namespace nda::recovery {

/// How to search a core.
struct CoreSearchOptions {
  std::size_t arcs_per_index = 20;  ///< size of the core, times the indices of the component
  int kicks_per_index =
      50;  ///< random moves, times the indices (or arcs, if fewer); 0 = descent only
  double neighbourhood_work = 0;  ///< of search_pool() after that
  double goal = -kInfinity;       ///< a packing this cheap ends the search
  core::ForAll for_all;           ///< of search_pool()
};

/// The core of a component: its arcs of reduced cost below `gap`, the cheapest arcs_per_index *
/// indices of them, and those of `keep`; ascending.  u: feasible multipliers by slot. With gap =
/// (best cost) - sum u no packing better than the best uses any other arc but for the size limit,
/// and for the arcs that were not looked at when the deadline struck.
std::vector<core::ArcId> core_arcs(const core::Component& component,
                                   std::span<const double> u,
                                   double gap,
                                   std::size_t arcs_per_index,
                                   std::span<const core::ArcId> keep,
                                   const core::Deadline& deadline = {});

/// Greedy by cost within the core of all arcs: the first solution, in memory independent of A.
core::Packing greedy_in_core(const core::Component& component,
                             std::span<const double> u,
                             std::size_t arcs_per_index,
                             const core::Deadline& deadline = {});

/// Local search within the core, from `start`, or from the dual-guided greedy packing if start is
/// empty. Never returns a packing dearer than `start`.  O(A N) to find the core, then independent
/// of A.
core::Packing search_core(const core::Component& component,
                          std::span<const double> u,
                          double gap,
                          const core::Packing& start,
                          const CoreSearchOptions& options,
                          core::Random& random,
                          const core::Deadline& deadline);

}  // namespace nda::recovery
