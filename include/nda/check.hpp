#pragma once

#include <string>
#include <vector>

#include "nda/problem.hpp"
#include "nda/proof.hpp"
#include "nda/solution.hpp"

namespace nda {

/// The verdict of the independent checker.
struct CheckReport {
  /// There is a solution, and every one uses every real index as often as it must and may (exactly
  /// once unless told otherwise), by arcs that exist, each once, and singletons that are not
  /// forbidden.
  bool feasible = false;
  bool cost_right = false;  ///< there is a solution, and every stated cost is the recomputed one
                            ///< (1e-9 relative)
  /// The multipliers, or the proof that was given, prove the stated bound; of an infeasible
  /// problem: some index has fewer arcs than it must use, mostly none, and a forbidden singleton.
  bool bound_right = false;
  /// The stated bound (or infeasibility) is said to rest on the search, and nothing denies it:
  /// that cannot be checked from the multipliers.  Never true together with bound_right.
  bool bound_by_branching = false;
  /// There are marginals, and they are those of the solutions as stated (1e-9 relative).
  bool marginals_right = false;
  double cost = kInfinity;                ///< recomputed, of the first solution
  double certificate_bound = -kInfinity;  ///< recomputed from the multipliers, rounded down
  double proof_bound = -kInfinity;        ///< what the proof shows; -inf without one
  std::vector<std::string> faults;        ///< one sentence each; empty when nothing is wrong

  /// Nothing is wrong.  A bound by branching passes: read bound_right for what is checked.
  bool passed() const { return faults.empty(); }
};

/// Checks a solution with code of its own: shares nothing with the solver but the two types, the
/// arithmetic of sums and certificate_bound().  O(A N).  Never throws on a wrong solution.
///
/// A claim that can be denied is a fault: optimal or proven where the bound does not meet the cost
/// to 1e-9 of the costs chosen, one of the two without the other, infeasible with a solution or
/// with all singletons free, no solution though all are free, a list that is not best first, has a
/// solution twice, or is said to have all without a proof of each, a stated certificate above the
/// real one, a bound above the cost, marginals that the solutions do not have.  Why a solve
/// stopped, and for gap_reached which gap was asked for, is not in the file and is not judged.
CheckReport check(const Problem& problem, const Solution& solution);

/// The same with a proof of the bound, see check_proof(): what branching adds to the certificate is
/// then judged too.  A proof with a fault is a fault, and so is one that falls short of the bound
/// of a cost that is stated to be proven; else it may, as limits leave trees unfinished.
CheckReport check(const Problem& problem, const Solution& solution, const Proof& proof);

/// The certificate: what no solution costs less than, whatever the multipliers,
///
///     sum over indices of (v < 0 ? hi : lo) v,  v = min(singleton's cost, u),
///     + sum over arcs of min(0, c_a - sum of u over a),
///
/// rounded downwards by its error bound; -inf where that overflows, and where an index that may be
/// used without limit has u < 0.  With bounds 1..1 the first line is the sum of v, that is sum u +
/// sum over singletons of min(0, s - u).  Derived in docs/many_to_one.md.
/// @param multipliers  u[k][i-1], M_k entries each; finite.  Throws InputError otherwise, naming
///                     the dimension.
double certificate_bound(const Problem& problem,
                         const std::vector<std::vector<double>>& multipliers);

}  // namespace nda
