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

/// What happened in one connected component.  Components come in the order of their smallest arc,
/// as tuples compare, of those that can improve on their singletons; of a many-to-one problem arcs
/// that nothing couples follow, then, by size, what indices with bounds connect.
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
  std::size_t components = 0;    ///< that the rules were applied to
  std::size_t arcs = 0;          ///< of these
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

/// What fixing by exchange did in a hot start, in all its rounds (docs/hot_starts.md).
struct ExchangeYield {
  std::size_t arcs = 0;      ///< looked at: all that can improve on their singletons
  std::size_t kept = 0;      ///< fixed to one: settled, some best solution has them
  std::size_t excluded = 0;  ///< fixed to zero: that best solution has none of them
  int rounds = 0;            ///< 0: there was no hot start, or nothing to start
};

/// What fixing by reduced costs did at the nodes of trees (docs/reductions.md).  It holds below its
/// node alone, so an arc counts as often as it is fixed.
struct FixingYield {
  std::size_t dropped = 0;  ///< arcs fixed to zero: too dear for the gap, or rivals of the taken
  std::size_t taken = 0;    ///< arcs fixed to one: the gap leaves an index of theirs no other use
  std::size_t splits = 0;   ///< nodes whose rest fell apart
  std::size_t parts = 0;    ///< into so many parts in all

  FixingYield& operator+=(const FixingYield& other);
};

/// Counters and times of one solve.  Times are wall seconds.
struct Stats {
  double read_seconds = 0;  ///< set by the command line
  double solve_seconds = 0;
  std::size_t peak_memory_bytes = 0;  ///< of the process
  std::int64_t dual_evaluations = 0;  ///< of all components
  std::int64_t recoveries = 0;        ///< feasible solutions constructed
  std::int64_t nodes = 0;             ///< of branch and bound
  std::size_t arcs_after_shift = 0;   ///< that can improve on singletons; all where nearly all can
  /// Arcs that reduced costs left when the first linear program of a component came, or its first
  /// node of Lagrangian branch and bound; all of a component that ended before.
  std::size_t arcs_after_fixing = 0;
  /// The fewest that reduced costs left of a component for a better packing, by whatever bound on
  /// all of it; all of a component that ended without.
  std::size_t arcs_left = 0;
  std::size_t tried_components = 0;       ///< that reductions had a look at
  std::size_t settled_components = 0;     ///< solved by reductions alone
  ReductionYield reductions;              ///< of those components
  ReductionYield forgotten_reductions;    ///< of the others: they were solved as if untouched
  ExchangeYield exchange;                 ///< of a hot start; its arcs are among arcs_after_shift
  FixingYield branching;                  ///< at nodes of Lagrangian branch and bound
  FixingYield searches;                   ///< in branch and cut, and in searches in the slack
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
