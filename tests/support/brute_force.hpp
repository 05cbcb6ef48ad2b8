#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "nda/problem.hpp"

namespace nda::support {

/// A feasible solution found by enumeration.
struct ExactSolution {
  double cost = 0;                       ///< arcs and singletons of all uncovered indices
  std::vector<std::vector<Index>> arcs;  ///< tuples with two or more real indices, lexicographic
};

/// The optimum by depth-first enumeration, or nothing when infeasible: the judge of every other
/// method, so it shares no code with any.
///
/// Take the first uncovered index; it is covered by its singleton (if finite) or by one of the arcs
/// that contain it and touch no covered index; try each.  A branch is left when its cost plus, for
/// every uncovered index, the cheapest share cost / (number of real indices) of anything containing
/// it cannot beat the best by more than rounding.  Costs are added in long double.
///
/// Meant for about 30 indices and 25 arcs; exponential.  Where any index has bounds of its own it
/// goes through all subsets of at most 20 arcs.
std::optional<ExactSolution> brute_force(const Problem& problem);

/// Every feasible solution, cheapest first (equal costs in any order), all bounds being 1..1.
/// Throws std::length_error when there are more than `limit`, std::invalid_argument where an index
/// has bounds of its own.
std::vector<ExactSolution> all_solutions(const Problem& problem, std::size_t limit = 200000);

/// The costs of all_solutions().
std::vector<double> all_costs(const Problem& problem, std::size_t limit = 200000);

}  // namespace nda::support
