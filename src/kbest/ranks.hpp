#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

// Lists of solutions.

/// How many ranks the first pass is for where long lists are made in passes, each for `growth`
/// times as many as the one before: a limit leaves what the last whole pass proved, and all of them
/// take little more than the last.  That is `least` or more, unless less is planned, and such that
/// the passes end at what is planned.
std::size_t first_pass(std::size_t least, std::size_t growth, std::size_t planned);

/// All from number `first` on; those of equal cost keep their order.
void sort_by_cost(std::vector<RankedSolution>& ranks, std::size_t first = 0);

/// Numbers them from 1 on.
void number(std::vector<RankedSolution>& ranks);

/// How many of the first are proven.
std::size_t num_proven(std::span<const RankedSolution> ranks);

/// Makes `ranks`, which are not empty, the solutions of `solution`, best first.  Cost and bound
/// follow the first of them, which is as proven as that of `solution` and may cost less: by
/// rounding where that was proven.  Where it was not, what meets the bound (to less than a step
/// where costs lie on a grid, else to rounding, docs/numerics.md) is optimal, unless precision was
/// lost.  Component reports stay as they are.
void adopt(const Problem& problem, Solution& solution, std::vector<RankedSolution> ranks);

}  // namespace nda::kbest
