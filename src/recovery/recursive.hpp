#pragma once

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "relax/relaxed_dual.hpp"

namespace nda::recovery {

/// Recursive recovery: the recovery problem, of n - m + 1 dimensions where the point keeps m of n
/// sets (m >= 2), is solved by relaxation to two sets and recovery again, down to two dimensions,
/// where it is exact; at three, a packing is recovered at every
/// nonsmooth step (report, section 5).  Components of the recovery problem are solved one by one;
/// those that the deadline leaves over stay uncovered.
///
/// @return  a packing in arcs of `component`, feasible always (3.9); never costs more than 0.
/// Source: report, section 3.2, sparse modifications included.
core::Packing recover_recursively(const core::Component& component,
                                  const relax::RelaxedDual& point,
                                  const RelaxationOptions& options,
                                  const core::Deadline& deadline);

}  // namespace nda::recovery
