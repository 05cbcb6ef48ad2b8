#pragma once

#include <cstdint>
#include <span>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/solution.hpp"

namespace nda::bnb {

/// What an exact search found below a cutoff.
struct SearchResult {
  core::Packing best;  ///< the best packing cheaper than the cutoff; meaningful if found
  bool found = false;
  bool complete =
      false;  ///< best is the optimum; or, if not found, no packing is cheaper than the cutoff
  double lower = -kInfinity;  ///< every packing costs at least min(lower, cutoff)
  std::int64_t nodes = 0;
  double work = 0;        ///< in the units of SlackLimits
  FixingYield searches;   ///< of searches within the slack
  FixingYield branching;  ///< of nodes that were bounded, fixed and split
};

/// Enumerates the packings of a component cheaper than `cutoff`, without any relaxation: by
/// search_slack() within what multipliers u (by slot, u <= 0, all reduced costs >= 0) leave.  Good
/// multipliers make it fast; any feasible ones make it right.
///
/// Stops after max_nodes or at the deadline with complete = false.
/// Cost: exponential; O(N A) memory.
SearchResult enumerate(const core::Component& component,
                       std::span<const double> u,
                       double cutoff,
                       std::int64_t max_nodes,
                       const core::Deadline& deadline = {});

}  // namespace nda::bnb
