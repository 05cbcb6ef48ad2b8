#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "recovery/packing_state.hpp"
#include "relax/collapse.hpp"

namespace nda::recovery {

/// The (N-m+1)-dimensional problem that recovers a packing from an index alignment of m kept sets,
/// eq. (3.7) and (3.8).
///
/// Dimension 0 numbers the aligned cells j = 1..M_0, the others are those of the component from m
/// on.  Row j owns the arcs of its cell, row 0 those of cell (0 .. 0).  The arc (j, 0..0), if there
/// is one, is the cost of leaving j alone; it is shifted away, so that the problem is in shifted
/// form again.
struct RecoveryProblem {
  int num_kept = 2;                      ///< m
  core::Component component;             ///< arc_origin: arcs of the component recovered from
  std::vector<core::ArcId> default_arc;  ///< [j]: arc used when row j stays uncovered, or kNoArc
};

/// @param aligned  the cells of the alignment, in any order.
/// Where the deadline strikes, later rows are without arcs.
RecoveryProblem make_recovery_problem(const core::Component& component,
                                      const relax::Cells& cells,
                                      std::span<const std::uint32_t> aligned,
                                      const core::Deadline& deadline = {});

/// The connected components of a recovery problem (4.7), or, if they are not to be told apart, the
/// one that they make together; their arc_origin are its arcs.  Those that the deadline leaves over
/// are not among them.
std::vector<core::Component> cut_parts(const RecoveryProblem& problem,
                                       const core::Deadline& deadline = {},
                                       bool decompose = true);

/// The packing of the component recovered from, that these arcs of the recovery problem and the
/// default arcs of all rows without one make.
core::Packing recovered_packing(const core::Component& component,
                                const RecoveryProblem& problem,
                                std::span<const core::ArcId> arcs);

}  // namespace nda::recovery
