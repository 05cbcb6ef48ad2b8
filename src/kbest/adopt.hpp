#pragma once

#include <vector>

#include "nda/solution.hpp"

namespace nda::kbest {

/// Makes `ranks`, which are not empty, the solutions of `solution`, numbered as they come.  Where
/// its first was not proven, the best of them may be better: then they are sorted, cost and bound
/// follow, and what meets the bound is optimal.  Costs of component reports
/// stay as they are.
void adopt(Solution& solution, std::vector<RankedSolution> ranks);

}  // namespace nda::kbest
