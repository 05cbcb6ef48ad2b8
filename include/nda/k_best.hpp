#pragma once

#include <cstddef>

#include "nda/options.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda {

/// The k best solutions of an N-dimensional assignment problem: as solve(), with up to k entries in
/// Solution::solutions, best first, all different.  Solutions of equal cost come in any order.
///
/// `proven` of an entry says that no other choice of so many solutions is better: the costs of the
/// proven entries are those of the best ones there are.  If all are proven and there are fewer than
/// k, there are no others.  Where the optimum is not proven, or a limit strikes while ranking, the
/// best of the solutions at hand follow without proof: those that differ from the first by one arc.
/// Status, bound and everything else are about the first, but for the time and the nodes.
///
/// Throws InputError for k = 0 and where solve() does.  Cost: one solve(), then O(A N) and a search
/// that is short where the optimum has little slack; exponential in the worst case.  Thread safe.
Solution solve_k_best(const Problem& problem, std::size_t k, const Options& options = {});

/// How many of the first solutions are proven.
std::size_t num_proven(const Solution& solution);

}  // namespace nda
