#pragma once

#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "recovery/recovery_problem.hpp"

namespace nda::recovery {

/// A part of a recovery problem (cut_parts()) and where it comes from.
struct RecoveryPart {
  const core::Component& component;  ///< recovered from
  const RecoveryProblem& problem;
  const core::Component& part;
};

/// What the inner problem says of a part of a recovery problem.
struct InnerResult {
  double lower = 0;       ///< bound on the packings of the part; -inf where the deadline struck
  std::vector<double> u;  ///< by slot of the part: where its own dual is to start
};

/// Maximises the dual of the inner problem: all dimensions of the component, but only the arcs of
/// the part and the default arcs of its rows.  Its bound is no worse than that of the component's
/// dual at the same multipliers, and it holds for every packing of this alignment.
///
/// @param u  multipliers by slot of the component: the start.
/// Cost: options.inner_evaluations evaluations of the dual function on those arcs.
/// Source: the paper on partial branch and bound, section 2.2; here for each part by itself.
InnerResult maximize_inner(const RecoveryPart& part,
                           std::span<const double> u,
                           const RelaxationOptions& options,
                           const core::Deadline& deadline);

}  // namespace nda::recovery
