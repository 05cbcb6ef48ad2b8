#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::pipeline {

/// An empty solution of this problem: sizes and number of arcs are set.
Solution solution_of(const Problem& problem);

/// [k][i]: whether an arc uses the index; entry 0 stands for the dummy.
using Coverage = std::vector<std::vector<bool>>;
Coverage coverage(const Problem& problem, std::span<const core::ArcId> arcs);

/// The solution of these arcs, ascending, which cover all indices with forbidden singletons; its
/// cost, summed in double-double, is theirs and that of the singletons of all others.
RankedSolution make_solution(const Problem& problem,
                             std::span<const core::ArcId> arcs,
                             const Coverage& covered);

}  // namespace nda::pipeline
