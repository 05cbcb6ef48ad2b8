#pragma once

#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"
#include "nda/warm_start.hpp"

namespace nda {

/// Solves an N-dimensional assignment problem.
///
/// Costs are shifted, the problem is split into connected components, small ones are solved
/// exactly, large ones by relaxation to two dimensions, recovery, reduced-cost fixing and
/// branching; the parts are merged.  Both bounds are always reported.  Same problem, seed and
/// options give the same answer whatever the number of threads, unless a time limit strikes.
///
/// Throws InputError only for options out of range and for a problem that was moved from; outcomes
/// are statuses.  Thread safe.
/// @param warm_start  what is known beforehand, see there: saves time, changes neither the cost nor
///                    that it is proven.  `components` are then those that it leaves open.  It is
///                    ignored with Options::proof, with Method::kRelaxation, and where singletons
///                    are forbidden, but for parts with bounds on uses.
Solution solve(const Problem& problem,
               const Options& options = {},
               const WarmStart& warm_start = {});

}  // namespace nda
