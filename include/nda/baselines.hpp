#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nda/problem.hpp"

namespace nda {

/// Answer of a baseline: the classic heuristics that every method is compared with.
struct BaselineResult {
  double cost = kInfinity;  ///< arcs and singletons of all uncovered indices; +inf if infeasible
  std::vector<std::vector<Index>> arcs;  ///< tuples with two or more real indices, lexicographic
  bool feasible = false;  ///< false: an index whose singleton is forbidden is used too rarely
};

// All heuristics work on shifted costs: c'_a = c_a - sum of the singleton costs of its indices, so
// that leaving an index alone costs 0, and only arcs with c'_a < 0 are of use.  A forbidden
// singleton counts as a price higher than any sum of costs: an arc that covers more such indices is
// the better one, whatever its cost. Where all singletons are finite every heuristic succeeds;
// otherwise it may fail though a solution exists.
//
// Bounds on uses are known to greedy and brute force; the others throw InputError where an index
// has bounds other than 1..1.

/// Greedy: again and again the cheapest arc (in shifted cost, ties by tuple) that meets no chosen
/// one. O(A log A + A N).  With bounds on uses: the arc that adds least to the cost, as long as
/// that is less than 0 and no index is used too often; O(A N^2 log A).
BaselineResult solve_greedy(const Problem& problem);

struct RandomizedGreedyOptions {
  int iterations = 100;  ///< independent constructions; the first is plain greedy; >= 1
  int candidates = 3;    ///< length of the restricted candidate list; >= 1, and 1 is plain greedy
  std::uint64_t seed = 1;
};

/// Randomised greedy: each step takes one of the `candidates` cheapest arcs that still fit, all
/// equally likely; the best of all iterations.  Throws InputError on an option out of range. O(A
/// log A + iterations A N). Source: the construction phase of GRASP (Feo & Resende, J. Global
/// Optim. 6, 1995) with a candidate list of fixed length.  The AFOSR report (1995, section 5) names
/// a randomised greedy but does not define it.
BaselineResult solve_randomized_greedy(const Problem& problem,
                                       const RandomizedGreedyOptions& options = {});

/// Max-regret: for every uncovered index the regret is the difference of its second-best and its
/// best choice (leaving it alone is one of them); the index of largest regret gets its best choice.
/// O(A N log(A N)).
/// Source: Balas & Saltzman, Oper. Res. 39(1), 1991 (for N = 3); here over the indices of all
/// dimensions.
BaselineResult solve_max_regret(const Problem& problem);

struct SgtsOptions {
  int max_partitions = 20;  ///< >= 1; the authors saw no improvement beyond about twenty
};

/// Semi-greedy track selection: the i-th partition starts with the best arc that no earlier
/// partition contains and is completed greedily; the best partition wins.  Ends when every arc was
/// in some partition, or at `max_partitions`.  Throws InputError on an option out of range.  O(A
/// log A + max_partitions A N).
///
/// Guarantee (Proposition 2, for the first partition, so for the best one too).  Let all singleton
/// costs be finite, S the cost of leaving every index alone, and d the largest number of real
/// indices in an arc of negative shifted cost (d <= N).  Then  S - optimum <= d (S - cost).  The
/// proof needs non-negative weights, which the paper leaves unsaid: here the weights are -c'_a of
/// the arcs with c'_a < 0.  The factor is sharp. Source: Capponi & de Waard, A polynomial time
/// algorithm for the multidimensional assignment problem in multiple sensor environments,
/// section 2.
BaselineResult solve_sgts(const Problem& problem, const SgtsOptions& options = {});

/// All partitions of semi-greedy track selection in the order of their making: no two are equal.
std::vector<BaselineResult> sgts_partitions(const Problem& problem,
                                            const SgtsOptions& options = {});

/// Sizes that solve_brute_force accepts.
inline constexpr std::size_t kBruteForceMaxArcs = 64;
inline constexpr std::size_t kBruteForceMaxIndices = 64;

/// The optimum by depth-first enumeration: exact, exponential, a judge for small problems.
/// Throws InputError when the problem has more than kBruteForceMaxArcs arcs or
/// kBruteForceMaxIndices real indices. feasible = false means that no solution exists.
BaselineResult solve_brute_force(const Problem& problem);

}  // namespace nda
