#pragma once

#include <cstddef>

#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// Replaces the solutions of `solution`, as solve() gave it, by up to k good ones, found by partial
/// branch and bound (options.ranking) in each component: best first, all different, none worse than
/// the one that was there.  Only the first can be proven, as it was or since it meets the bound.
void rank_near_optimal(const Problem& problem,
                       Solution& solution,
                       std::size_t k,
                       const Options& options);

}  // namespace nda::kbest
