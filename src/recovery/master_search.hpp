#pragma once

#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/for_all.hpp"
#include "core/random.hpp"
#include "cutting/master.hpp"

namespace nda::recovery {

/// How to search by a solved master.
struct MasterSearchOptions {
  std::size_t arcs_per_index = 20;  ///< the cheapest arcs only, so many times the indices
  double max_work = 0;              ///< of searches (PoolSearchOptions)
  double least_round_work = 0;      ///< PoolSearchOptions
  double swap_work = 0;             ///< PoolSearchOptions
  double goal = -kInfinity;         ///< a packing this cheap ends the search
  core::ForAll for_all;             ///< PoolSearchOptions
};

/// search_pool() by the multipliers of a solved master, those of its cuts included, among its live
/// arcs.  Never returns a packing dearer than `start`, which may use any arcs.
/// @param others  more packings to start from.
core::Packing search_by_master(const core::Component& component,
                               const cutting::Master& master,
                               const core::Packing& start,
                               const std::vector<core::Packing>& others,
                               const MasterSearchOptions& options,
                               core::Random& random,
                               const core::Deadline& deadline);

}  // namespace nda::recovery
