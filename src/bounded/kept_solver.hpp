#pragma once

#include "bounded/kept_dual.hpp"
#include "bounded/lagrangian.hpp"
#include "core/clock.hpp"
#include "nda/options.hpp"

namespace nda::bounded {

/// Solves relaxed problems (3.4) of three and more kept dimensions, component by component: those
/// of at most options.kept_exact_arcs arcs by linear programs and branching of at most
/// options.kept_nodes nodes; others, and those that this does not end, by relaxation to
/// min(kept_sets, m - 1) dimensions with recovery, options.kept_evaluations evaluations, and so on
/// down to two.
KeptSolver make_kept_solver(const RelaxationOptions& options, const core::Deadline& deadline);

/// The loop as these options want it: kept dimensions, method and tolerance.
LagrangianOptions loop_options(const RelaxationOptions& options, const core::Deadline& deadline);

}  // namespace nda::bounded
