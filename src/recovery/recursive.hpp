#pragma once

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "relax/dual_function.hpp"

namespace nda::recovery {

/// The (N-1)-dimensional problem that recovers a packing from an index alignment, eq. (3.7) and
/// (3.8).
///
/// Dimension 0 numbers the aligned cells j = 1..M_0, the others are those of the component from 2
/// on.  Row j owns the arcs of its cell, row 0 those of cell (0, 0).  The arc (j, 0..0), if there
/// is one, is the cost of leaving j alone; it is shifted away, so that the problem is in shifted
/// form again.
struct RecoveryProblem {
  core::Component component;             ///< arc_origin: arcs of the component recovered from
  std::vector<core::ArcId> default_arc;  ///< [j]: arc used when row j stays uncovered, or kNoArc
};

/// Where the deadline strikes, later rows are without arcs.
RecoveryProblem make_recovery_problem(const core::Component& component,
                                      const relax::DualFunction& point,
                                      const core::Deadline& deadline = {});

/// Recursive recovery: the recovery problem is solved by relaxation to two dimensions and recovery
/// again, down to two dimensions, where it is exact; at three, a packing is recovered at every
/// nonsmooth step (report, section 5).  Components of the recovery problem are solved one by one;
/// those that the deadline leaves over stay uncovered.
///
/// @return  a packing in arcs of `component`, feasible always (3.9); never costs more than 0.
/// Source: report, section 3.2, sparse modifications included.
core::Packing recover_recursively(const core::Component& component,
                                  const relax::DualFunction& point,
                                  const RelaxationOptions& options,
                                  const core::Deadline& deadline);

}  // namespace nda::recovery
