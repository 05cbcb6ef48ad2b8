#pragma once

#include <string>

#include "nda/solution.hpp"

namespace nda::core {

/// Whether Solution::marginals, which there are, are those of the solutions in the list: one
/// sentence on the first thing that is wrong, or empty.  Each number must be right to 1e-9 of it
/// (entropies to 1e-12), every list complete and in its order; costs count as stated.
///
/// The solutions must be feasible for `solution.sizes`; one that uses an index twice has no
/// marginals. Never throws on wrong marginals. Cost: O(arcs of all solutions log A + solutions x
/// indices), and O(N^2) for each arc.
std::string marginals_fault(const Solution& solution);

}  // namespace nda::core
