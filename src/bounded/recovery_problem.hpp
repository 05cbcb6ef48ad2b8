#pragma once

#include <span>

#include "bounded/cells.hpp"

namespace nda::bounded {

/// The (N-m+1)-dimensional problem that recovers a choice from an index alignment of m kept
/// dimensions, eq. (3.7) and (3.8) with bounds.
///
/// Dimension 0 numbers the aligned cells j = 1..M_0, those of the arcs that a relaxed solution
/// chose; the others are those of the component from m on, with their rows.  Row j owns the arcs of
/// its cell and may be used as often as the alignment uses it, so no kept index is used too often;
/// row 0 owns those of cell (0 .. 0).  What row j pays for each use that it lacks:
///
/// - for a kept index that the alignment uses no more than `lo` times its singleton, as in the
///   report, where c(j 0..0) is the sum of singletons.  It is taken off the arcs.
/// - for one that is used more often, that for the first `lo` of its uses, in the order of reduced
///   costs; the others may stay away for nothing.
///
/// So the choice that a solution is (3.9) costs what the recovery problem says and a constant, or
/// less: less only where one of the first uses stays away.
///
/// arc_origin are arcs of the component recovered from.
///
/// @param chosen   arcs that use no kept index more often than `hi`; those of cell (0 .. 0) are of
///                 no interest
/// @param reduced  [arc] reduced costs, kept dimensions left out
BoundedComponent make_recovery_problem(const BoundedComponent& component,
                                       const Cells& cells,
                                       std::span<const core::ArcId> chosen,
                                       std::span<const double> reduced);

}  // namespace nda::bounded
