#pragma once

#include <optional>
#include <vector>

#include "core/component.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::pipeline {

/// The solution of these arcs of a problem with bounds, its cost summed in double-double; nothing
/// where an index is used more often than it may be, or too seldom with a forbidden singleton.
std::optional<RankedSolution> solution_of_uses(const Problem& problem,
                                               std::vector<core::ArcId> arcs);

/// Lowers the multipliers of indices that may not be used at all, [k][i-1], until none of their
/// arcs seems to pay: that costs the bound nothing.
void release_unusable(const Problem& problem, std::vector<std::vector<double>>& multipliers);

}  // namespace nda::pipeline
