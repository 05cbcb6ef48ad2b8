#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "nda/problem.hpp"
#include "nda/types.hpp"

namespace nda {

/// A two-dimensional assignment problem with outside options, by rows (compressed sparse rows).
///
///     minimise  sum of cost over chosen pairs + row_outside over unassigned rows
///                                             + column_outside over unassigned columns,
///     every row and column in at most one pair.
///
/// Rows and columns count from 0.  An outside cost of +inf means "must be assigned"; a pair that is
/// absent, or of cost +inf, is forbidden.  Columns ascend within a row and do not repeat.
/// All other costs are finite; solvers check nothing (see validate()).
///
/// *Many-to-one*: with bounds, a row is in lo..hi pairs, what it is short of lo pays its outside
/// cost so many times (where that is negative: what it is short of hi), and columns alike.  Only
/// Assign2dMethod::kNetworkSimplex knows bounds.
struct Assign2dProblem {
  std::span<const std::uint32_t> row_start;       ///< num_rows + 1 entries
  std::span<const std::uint32_t> column;          ///< of each pair
  std::span<const double> cost;                   ///< of each pair
  std::span<const double> row_outside;            ///< num_rows entries
  std::span<const double> column_outside;         ///< num_columns entries
  std::span<const UseBounds> row_bounds = {};     ///< num_rows entries, or none: all 1..1
  std::span<const UseBounds> column_bounds = {};  ///< num_columns entries, or none

  bool has_bounds() const { return !row_bounds.empty() || !column_bounds.empty(); }
  std::uint32_t num_rows() const { return static_cast<std::uint32_t>(row_outside.size()); }
  std::uint32_t num_columns() const { return static_cast<std::uint32_t>(column_outside.size()); }
};

/// Not assigned.
inline constexpr std::int32_t kUnassigned = -1;

/// Answer of a two-dimensional solver.
///
/// When feasible the duals prove optimality: u[i] + v[j] <= cost(i, j) for every pair, u <=
/// row_outside, v <= column_outside, with equality for chosen pairs and for unassigned rows and
/// columns (to rounding), so that sum u + sum v = cost.  When infeasible, `hall_rows` or
/// `hall_columns` names a set that cannot all be assigned: together they have fewer partners than
/// members.  cost is then +inf, the duals are meaningless.
///
/// Of a problem with bounds `pairs` are the chosen ones, and column_of_row and row_of_column are
/// empty.  With f(n) = outside * max(0, lo - n) of a row or column (lo = hi where outside < 0)
/// the duals prove
///
///     cost = sum over rows and columns of min over 0 <= n <= hi of f(n) + dual * n
///          + sum over pairs of min(0, cost(i, j) - u[i] - v[j]),
///
/// to rounding, or to about 2^-40 of the largest cost where costs are no integers; hall_rows and
/// hall_columns stay empty.
struct Assign2dResult {
  bool feasible = true;
  double cost = 0;
  std::vector<std::int32_t> column_of_row;  ///< kUnassigned = outside option
  std::vector<std::int32_t> row_of_column;
  std::vector<double> u;  ///< dual of each row
  std::vector<double> v;  ///< dual of each column
  std::vector<std::uint32_t> hall_rows;
  std::vector<std::uint32_t> hall_columns;
  std::vector<std::uint32_t> pairs;  ///< many-to-one: numbers of the chosen pairs, ascending
};

/// Which algorithm solves it.  All are exact; docs/assign2d.md says which one when.
enum class Assign2dMethod {
  kShortestPath,    ///< shortest augmenting paths, sparse or dense as the problem is
  kAuction,         ///< forward/reverse auction with epsilon scaling
  kNetworkSimplex,  ///< LEMON's network simplex: the slow reference, and many-to-one
};

/// A solve was given up because Assign2dSolver::set_stop() asked for it.
class Assign2dInterrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "the assignment was interrupted"; }
};

/// Solves many problems one after the other, as a dual loop does.
///
/// Memory is kept between calls: once a shape has been seen, kShortestPath and kAuction allocate
/// nothing (kNetworkSimplex builds LEMON's graph anew each time).  An object is used by one thread
/// at a time; nothing but memory, and an index of the last sparsity pattern, is remembered.
class Assign2dSolver {
 public:
  virtual ~Assign2dSolver() = default;

  /// Solves from scratch.  What `result` held is replaced, its memory is reused.
  void solve(const Assign2dProblem& problem, Assign2dResult& result) {
    do_solve(problem, result, false);
  }

  /// Solves from what is in `result`: v become the starting prices and column_of_row is preferred
  /// where it is still best.  Any v is a valid start, one of a similar problem is a fast one.
  /// The optimum is the same as that of solve(), which is called where `result` is infeasible, of
  /// another shape, or holds prices that are not finite or far beyond the costs of `problem`.
  /// kNetworkSimplex always starts from scratch.
  void solve_warm(const Assign2dProblem& problem, Assign2dResult& result) {
    do_solve(problem, result, true);
  }

  /// From now on a solve asks `stop` (null: nobody) every 50000 pairs or so that it looks at, and
  /// throws Assign2dInterrupted when that answers true.  `result` is then of the right shape, has
  /// finite duals and assigns nobody twice, but proves nothing.  kNetworkSimplex asks only at the
  /// end.
  virtual void set_stop(const std::function<bool()>* stop) = 0;

 private:
  virtual void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) = 0;
};

std::unique_ptr<Assign2dSolver> make_assign2d_solver(Assign2dMethod method);

/// Solves one problem.  Throws InputError where validate() does, and where the problem has bounds
/// that the method does not know.
Assign2dResult assign2d(const Assign2dProblem& problem,
                        Assign2dMethod method = Assign2dMethod::kShortestPath);

/// Solves one dense problem as scipy's linear_sum_assignment does: every member of the smaller side
/// is assigned, of a square problem every row and column; surplus members of the larger side are
/// free of charge.
///
/// @param cost_row_major  num_rows * num_columns costs; +inf forbids a pair.
/// Throws InputError for another size, and for costs NaN or -inf.
Assign2dResult assign2d(std::span<const double> cost_row_major,
                        std::uint32_t num_rows,
                        std::uint32_t num_columns,
                        Assign2dMethod method = Assign2dMethod::kShortestPath);

/// Throws InputError naming the first entry that breaks the contract of Assign2dProblem: sizes that
/// disagree, rows out of order, columns out of range or order, costs NaN or -inf, lo above hi, no
/// least cost since hi is unlimited where the outside cost is negative.
void validate(const Assign2dProblem& problem);

}  // namespace nda
