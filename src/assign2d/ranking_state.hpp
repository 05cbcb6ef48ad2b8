#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/side.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// Which entries of the log of a RankingState belong together.
struct ChangeRange {
  std::uint32_t row_begin = 0;
  std::uint32_t row_end = 0;
  std::uint32_t price_begin = 0;
  std::uint32_t price_end = 0;
};

/// An assignment with its duals that can turn into others and back.
///
/// Whatever changes is logged.  A range of the log holds the values on the other side of the
/// change: undoing or redoing it swaps them with those of the state.  u is a function of assignment
/// and v.
class RankingState {
 public:
  /// Of an unassigned column.
  std::uint32_t nobody() const { return static_cast<std::uint32_t>(row_outside_.size()); }

  /// Becomes the assignment `best`; the log is empty.
  /// @param problem  must outlive the state.
  void start(const Assign2dProblem& problem, const Assign2dResult& best);

  std::uint32_t column_of_row(std::uint32_t i) const { return column_of_row_[i]; }  ///< or kNone
  std::uint32_t row_of_column(std::uint32_t j) const { return row_of_column_[j]; }  ///< or nobody()
  double u(std::uint32_t i) const { return u_[i]; }
  double v(std::uint32_t j) const { return v_[j]; }
  double row_outside(std::uint32_t i) const { return row_outside_[i]; }
  double column_outside(std::uint32_t j) const { return column_outside_[j]; }
  std::span<const double> u() const { return u_; }
  std::span<const double> v() const { return v_; }
  std::uint32_t num_rows() const { return static_cast<std::uint32_t>(u_.size()); }
  std::uint32_t num_columns() const { return static_cast<std::uint32_t>(v_.size()); }

  /// Row i takes column j at that cost, or its outside option (kNone).  Its former column is the
  /// caller's business.
  void choose(std::uint32_t i, std::uint32_t j, double cost);
  /// Column j is left alone.  Not logged: what a row does next to each of its columns is.
  void release(std::uint32_t j) { row_of_column_[j] = nobody(); }
  /// Takes back release() where no row changed its mind.
  void hold(std::uint32_t j, std::uint32_t i) { row_of_column_[j] = i; }
  void set_price(std::uint32_t j, double price);
  void forget_log();
  /// The price of the column that row i has, if any, as it is before shift_dual().
  void log_price(std::uint32_t i) {
    const std::uint32_t j = column_of_row_[i];
    if (j != kNone) price_changes_.push_back({j, v_[j]});
  }
  /// The dual of row i rises, the price of its column falls.  Not logged; of an unassigned row
  /// nothing moves.
  void shift_dual(std::uint32_t i, double rise) {
    if (column_of_row_[i] == kNone) return;
    v_[column_of_row_[i]] -= rise;
    refresh_row(i);
  }
  /// Brings u up to date with the changes of a range.
  void refresh(const ChangeRange& range);

  /// The log from here on is empty.
  ChangeRange open_range() const;
  /// Closes a range at the end of the log.
  void close_range(ChangeRange& range) const;
  void undo(const ChangeRange& range);
  void redo(const ChangeRange& range);
  /// Undoes the last range and takes it out of the log.
  void drop(const ChangeRange& range);

  /// Writes assignment, duals and cost, which is summed afresh.  O(rows + columns).
  void write(Assign2dResult& result) const;

 private:
  struct RowChange {
    std::uint32_t row;
    std::uint32_t column;
    double cost;
  };
  struct PriceChange {
    std::uint32_t column;
    double price;
  };

  void release_rows(const ChangeRange& range);
  void swap_row(RowChange& change);
  void swap_price(PriceChange& change);
  void refresh_row(std::uint32_t i) {
    u_[i] = column_of_row_[i] == kNone ? row_outside_[i] : row_cost_[i] - v_[column_of_row_[i]];
  }
  void hold_rows(const ChangeRange& range);
  void refresh_rows(const ChangeRange& range);
  std::span<const double> row_outside_;
  std::span<const double> column_outside_;
  std::vector<std::uint32_t> column_of_row_;
  std::vector<std::uint32_t> row_of_column_;
  std::vector<double> row_cost_;  // of the choice of each row
  std::vector<double> u_;
  std::vector<double> v_;
  std::vector<RowChange> row_changes_;
  std::vector<PriceChange> price_changes_;
};

}  // namespace nda::lap
