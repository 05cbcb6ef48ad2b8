#pragma once

#include <functional>

#include "core/shift.hpp"
#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::pipeline {

/// The penalties of forbidden singletons are so high that rounding them would hide differences of
/// costs: of a step of the grid, or, where there is none, of 1e-9 of the largest cost.
bool hides_digits(const Problem& problem, const core::Shift& shift, const core::CostGrid& grid);

/// A penalty that leaves the costs their digits and is nearly always enough, as what covers an
/// index seldom costs more than a few arcs for every dimension: 16 (N + 1) times the largest |c|.
double modest_penalty(const Problem& problem);

/// What a run came to, and whether the best solution leaves an index uncovered that a higher
/// penalty might cover.
struct PenalisedRun {
  Solution solution;
  bool needs_higher_penalty = false;
};

/// Runs with modest penalties, and again with high ones if need be: with the time that is left, and
/// with progress that goes on from the first.  Limits other than time are those of each run.
Solution solve_by_penalties(
    const Options& options,
    const std::function<PenalisedRun(const Options& options, bool modest)>& run);

}  // namespace nda::pipeline
