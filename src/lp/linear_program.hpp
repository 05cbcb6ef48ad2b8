#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "nda/types.hpp"

namespace nda::lp {

/// A sparse vector: entry k has number index[k].
struct SparseView {
  std::span<const int> index;
  std::span<const double> value;
};

/// How a solve ended.
enum class Outcome {
  kOptimal,
  kCutoff,   ///< the objective passed the limit that was set: dual() proves it
  kStopped,  ///< iteration limit or deadline
  kFailed,   ///< numerical trouble
};

/// minimise c x so that rows are at most (or exactly) their right-hand side and 0 <= x <= upper:
/// a linear program that grows and shrinks between solves, each of which starts from the last
/// basis.
///
/// The adapter to COIN's CLP (Debian: coinor-libclp-dev), the only place that knows it.  Numbers
/// are doubles to CLP's tolerance of 1e-7: bounds that must hold are computed from dual() by the
/// caller.
class LinearProgram {
 public:
  LinearProgram();
  ~LinearProgram();
  /// With its basis.
  LinearProgram(const LinearProgram& other);
  LinearProgram& operator=(const LinearProgram&) = delete;

  /// Appends rows sum of nothing <= 1.
  void add_empty_rows(int count);
  /// Appends a row <= right_side over columns that are there.  Collected and handed over at the
  /// next solve, like columns.
  void add_row(SparseView row, double right_side);
  /// Appends a column; rows must be there.  Collected and handed over at the next solve.
  void add_column(SparseView column, double cost, double upper);
  /// Removes rows or columns; the later ones move up.  Where a row was not slack, solve_primal()
  /// must come next: too many columns are left in the basis, and CLP's dual method would end the
  /// program.
  void remove_rows(std::span<const int> rows);
  void remove_columns(std::span<const int> columns);
  /// Whether a row has its slack in the basis.
  bool is_slack(int row) const;
  void set_upper(int column, double upper);
  /// 0 <= lower <= upper of a column that is there; 0 at first.
  void set_lower(int column, double lower);
  /// Makes a row an equality, or an inequality again.
  void set_equality(int row, bool equality);

  int num_rows() const;
  int num_columns() const;

  /// Primal simplex: after columns were added.
  Outcome solve_primal(const core::Deadline& deadline);
  /// Dual simplex: after rows were added or bounds changed.  Stops when the objective exceeds
  /// `objective_limit` or after `max_iterations`.
  Outcome solve_dual(const core::Deadline& deadline, double objective_limit, int max_iterations);

  double objective() const;
  std::span<const double> primal() const;  ///< [column]
  std::span<const double> dual() const;    ///< [row]; <= 0 where the row is an inequality
  std::int64_t iterations() const { return iterations_; }

  /// The basis, to come back to after a trial.
  std::vector<unsigned char> basis();
  void set_basis(const std::vector<unsigned char>& basis);

 private:
  void watch_deadline();
  void hand_over();
  void hand_over_rows();
  void hand_over_columns();
  void choose_scaling();
  template <typename Algorithm>
  Outcome run(const core::Deadline& deadline,
              double objective_limit,
              int max_iterations,
              Algorithm algorithm);

  struct Clp;
  std::unique_ptr<Clp> clp_;
  std::int64_t iterations_ = 0;
};

}  // namespace nda::lp
