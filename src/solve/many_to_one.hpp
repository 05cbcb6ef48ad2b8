#pragma once

#include <functional>

#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"
#include "nda/warm_start.hpp"

namespace nda::pipeline {

/// How the part of a problem is solved whose indices are to be used once.
using SolveOnce = std::function<Solution(
    const Problem& problem, const Options& options, const WarmStart& warm_start)>;

/// The pipeline of problems with bounds other than 1..1: split, solve the parts with bounds by
/// flows, linear programs and branching, the rest as an ordinary problem, merge.  Throws InputError
/// where a proof is asked for: it has no form for bounds yet.
Solution solve_many_to_one(const Problem& problem,
                           const Options& options,
                           const WarmStart& warm_start,
                           const SolveOnce& solve_once);

}  // namespace nda::pipeline
