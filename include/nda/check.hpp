#pragma once

#include <string>
#include <vector>

#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda {

/// The verdict of the independent checker.
struct CheckReport {
  bool feasible =
      false;  ///< every real index used exactly once, every arc exists, nothing forbidden
  bool cost_right = false;  ///< the stated cost is the recomputed one (1e-9 relative)
  bool bound_right =
      false;  ///< the stated bound is not above what the multipliers or branching prove
  bool bound_by_branching =
      false;  ///< the stated bound exceeds the certificate's: not checkable without a proof
  double cost = kInfinity;                ///< recomputed, of the first solution
  double certificate_bound = -kInfinity;  ///< recomputed from the multipliers, rounded down
  std::vector<std::string> faults;        ///< one sentence each; empty when all is right

  bool passed() const { return faults.empty(); }
};

/// Checks a solution with code of its own: shares nothing with the solver but the two types.
/// O(A N).  Never throws on a wrong solution.  A claim that the bounds deny is a fault too: optimal
/// or proven with a gap, infeasible with a solution.
CheckReport check(const Problem& problem, const Solution& solution);

/// The certificate: sum u + sum over arcs and singletons of min(0, c_a - sum of u over a), rounded
/// downwards by its error bound; -inf where that overflows.
/// @param multipliers  u[k][i-1], M_k entries each; finite.  Throws InputError otherwise, naming
/// the
///                     dimension.
double certificate_bound(const Problem& problem,
                         const std::vector<std::vector<double>>& multipliers);

}  // namespace nda
