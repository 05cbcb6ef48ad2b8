#pragma once

#include "bnb/proof_log.hpp"
#include "core/clock.hpp"
#include "core/for_all.hpp"

namespace nda::cutting {

/// What all stages of the search of one component share, from the circles down to the leaves.
struct SearchContext {
  double step = 0;  ///< bnb::SlackLimits::step
  /// Most tuples are arcs: budgets of searches within the slack widen by the arcs they pay for.
  bool is_dense = false;
  core::Deadline deadline;
  core::ForAll
      for_all;  ///< of patterns, of the parts of long searches, of the nodes of large trees
  bnb::ProofLog* proof = nullptr;  ///< where to write down why the bound holds; may be null
};

}  // namespace nda::cutting
