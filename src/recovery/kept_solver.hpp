#pragma once

#include "core/clock.hpp"
#include "nda/options.hpp"
#include "relax/lagrangian.hpp"

namespace nda::recovery {

/// Solves relaxed problems (3.4) of three and more kept sets.  From the last multipliers: those of
/// at most options.kept_exact_arcs arcs below 0 exactly, by enumeration or branch and cut of at
/// most options.kept_nodes nodes; others, and those that this does not end, by relaxation to
/// min(kept_sets, m - 1) sets with recovery, options.kept_evaluations evaluations, and so on down
/// to two.
relax::KeptSolver make_kept_solver(const RelaxationOptions& options,
                                   const core::Deadline& deadline);

/// Makes the loop keep as many sets as the options say, with that solver behind it.
void keep_sets(const RelaxationOptions& options,
               const core::Deadline& deadline,
               relax::LagrangianOptions& loop);

}  // namespace nda::recovery
