#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nda/marginals.hpp"
#include "nda/proof.hpp"
#include "nda/types.hpp"

namespace nda {

/// Why the solver stopped.  It says nothing of quality: see Solution::proven and the two bounds.
///
/// | status         | solutions       | lower_bound, multipliers     | reason        |
/// |----------------|-----------------|------------------------------|---------------|
/// | optimal        | the best        | valid, meets the cost        | empty         |
/// | gap_reached    | good enough     | valid, within the asked gap  | empty         |
/// | time_limit     | best so far     | valid                        | empty         |
/// | iteration_limit| best so far     | valid                        | empty         |
/// | node_limit     | best so far     | valid                        | empty         |
/// | interrupted    | best so far     | valid                        | empty         |
/// | infeasible     | none            | bound +inf, no certificate   | who and why   |
/// | precision_lost | best so far     | valid, need not meet cost    | what is known |
///
/// gap_reached: a gap above 0 was asked for.  iteration_limit: Method::kRelaxation ended, at its
/// limit of evaluations or because its bound no longer rises.
///
/// After a limit `solutions` is empty when no feasible solution was found (possible only where
/// singletons are forbidden, or their sum overflows); then cost is +inf and lower_bound still
/// holds.  Precision_lost because costs exceed 1e100: nothing is searched, the solution leaves
/// every index alone, the multipliers are 0.  Infeasible: there are no multipliers, the certificate
/// is -inf, and it is the search that proves lower_bound = +inf.
enum class Status {
  kOptimal,
  kGapReached,
  kTimeLimit,
  kIterationLimit,
  kNodeLimit,
  kInterrupted,
  kInfeasible,
  kPrecisionLost,
};

/// The name used in files and logs: "optimal", "gap_reached", ...
const char* to_string(Status status);

/// One feasible solution.
struct RankedSolution {
  int rank = 1;         ///< 1 = best
  double cost = 0;      ///< of the arcs and of the singletons of all uncovered indices
  bool proven = false;  ///< no better solution of this rank exists
  std::vector<std::vector<Index>> arcs;  ///< tuples with two or more real indices, lexicographic
};

/// What happened in one connected component (components in order of their smallest index; of a
/// many-to-one problem those that indices with bounds connect come last, by size).
struct ComponentReport {
  std::size_t num_arcs = 0;          ///< after the cost shift
  std::size_t num_indices = 0;       ///< real indices it touches; 0: bounds of none of them bind
  Status status = Status::kOptimal;  ///< why work on it ended; optimal exactly where proven
  bool proven = false;
  double cost = 0;         ///< contribution to the total cost; +inf if it was not found feasible
  double lower_bound = 0;  ///< on that contribution; +inf if it is infeasible
  std::string
      method;  ///< "reductions", "enumeration", "assignment", "relaxation", "branch and cut", ...
};

/// What each reduction did (docs/reductions.md).
struct ReductionYield {
  std::size_t outweighing = 0;   ///< arcs taken, as they outweigh all they exclude
  std::size_t excluded = 0;      ///< arcs that these exclude
  std::size_t redundant = 0;     ///< indices relieved, as another one speaks for them
  std::size_t single = 0;        ///< arcs that became the cost of leaving their index alone
  std::size_t unprofitable = 0;  ///< arcs that cost no less than these
  std::size_t dominated = 0;     ///< arcs that others within their indices replace
  std::size_t sides = 0;         ///< parts that hung on the rest by one index
  std::size_t side_arcs = 0;     ///< arcs that went with them
  std::size_t left = 0;          ///< arcs that no rule removed

  ReductionYield& operator+=(const ReductionYield& other);
};

/// Counters and times of one solve.  Times are wall seconds.
struct Stats {
  double read_seconds = 0;  ///< set by the command line
  double solve_seconds = 0;
  std::size_t peak_memory_bytes = 0;      ///< of the process
  std::int64_t dual_evaluations = 0;      ///< of all components
  std::int64_t recoveries = 0;            ///< feasible solutions constructed
  std::int64_t nodes = 0;                 ///< of branch and bound
  std::size_t arcs_after_shift = 0;       ///< arcs that can improve on their singletons
  std::size_t arcs_after_fixing = 0;      ///< arcs left when reduced-cost fixing ended
  std::size_t settled_components = 0;     ///< solved by reductions alone
  ReductionYield reductions;              ///< of those components
  double certificate_bound = -kInfinity;  ///< what the multipliers alone prove; -inf without any
  bool bound_by_branching = false;  ///< lower_bound exceeds certificate_bound: the search proved it
};

/// Result of a solve: both bounds, always.  See Status for which fields hold what.
struct Solution {
  std::vector<Index> sizes;        ///< M_k of the instance
  std::size_t num_arcs = 0;        ///< of the instance
  std::size_t num_components = 0;  ///< with at least one arc after the shift
  Status status = Status::kInterrupted;
  bool proven = false;              ///< cost is the optimum (to the tolerance of docs/numerics.md)
  double cost = kInfinity;          ///< of the best solution; +inf if none
  double lower_bound = -kInfinity;  ///< no solution costs less
  std::vector<RankedSolution> solutions;  ///< best first
  bool lists_all = false;  ///< solve_k_best(): these are all proven, and there are no others

  /// u[k][i-1] for i = 1..M_k: an all-relaxed certificate.  With u of the dummies 0,
  /// bound = sum u + sum over arcs and singletons of min(0, c_a - sum of u over a)
  /// holds for every u (report, Theorem 4.1); see nda/check.hpp.
  std::vector<std::vector<double>> multipliers;

  /// Why lower_bound holds, for check_proof(); with Options::proof only.  There is none of
  /// infeasible problems, nor where the deadline struck before every component had a bound.  It may
  /// show less than lower_bound where a limit stopped the search, where Lagrangian branch and bound
  /// had the last word (Method::kExact, more than two million arcs), where the relaxation kept
  /// three sets and more, and by what rounding takes.
  std::optional<Proof> proof;

  /// What the list says of arcs and indices, where somebody asked marginals() and put it here, for
  /// files and check().
  std::optional<Marginals> marginals;

  std::vector<ComponentReport> components;
  Stats stats;
  std::string
      reason;  ///< infeasible: which indices cannot all be covered; precision_lost: what is known

  /// cost - lower_bound; +inf when either is infinite.
  double gap() const;
  /// gap / max(1e-9, |cost|); +inf when the gap is.
  double relative_gap() const;
};

}  // namespace nda
