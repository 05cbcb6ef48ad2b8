#pragma once

#include <compare>
#include <string>
#include <vector>

#include "core/clock.hpp"
#include "nda/problem.hpp"

namespace nda::pipeline {

/// A real index: dimension k (from 0) and number i (from 1).
struct RealIndex {
  int dimension;
  Index index;

  friend auto operator<=>(const RealIndex&, const RealIndex&) = default;
};

/// The reason of an infeasible problem in one sentence: an index without arcs, or a set of indices
/// that cannot all be covered, whatever becomes of the others; where that would take too long, or
/// longer than the deadline lets it, only how many stay uncovered.  `uncovered`:
/// forbidden-singleton indices that the best solution of the penalised problem leaves uncovered; it
/// covers as many as can be covered at once as far as the penalty sees.
std::string infeasibility_reason(const Problem& problem,
                                 const std::vector<RealIndex>& uncovered,
                                 const core::Deadline& deadline = {});

/// Indices that no arc contains though their singleton is forbidden.
std::vector<RealIndex> indices_without_arcs(const Problem& problem);

}  // namespace nda::pipeline
