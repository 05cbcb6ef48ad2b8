#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/ranking_core.hpp"
#include "assign2d/ranking_state.hpp"
#include "assign2d/side.hpp"

namespace nda::lap {

/// What an assignment of a subset may do: rows that are not open keep what they have, and one open
/// row must not repeat its former choices.
class RankingSubproblem {
 public:
  /// Before anything else.
  void resize(std::uint32_t num_rows, std::uint32_t num_columns) {
    open_.assign(num_rows + 1, 0);
    forbidden_.assign(num_columns + 1, 0);
    now_ = 0;
    forbidding_now_ = 0;
    clear();
  }
  /// No row is open, nothing forbidden.  Constant time.
  void clear() {
    open_.back() = ++now_;
    allow();
  }
  void open(std::uint32_t row) { open_[row] = now_; }
  void close(std::uint32_t row) { open_[row] = 0; }
  /// All that is forbidden must be forbidden to the same row.
  void forbid(std::uint32_t row, std::uint32_t choice) {
    forbidding_row_ = row;
    forbidden_[place(choice)] = forbidding_now_;
  }
  /// Nothing is forbidden.
  void allow() {
    ++forbidding_now_;
    forbidding_row_ = kNone;
  }

  /// Also true of RankingState::nobody(): a column that has no row is there to be taken.
  bool is_open(std::uint32_t row) const { return open_[row] == now_; }
  /// choice: a column, or kNone for the outside option.
  bool allows(std::uint32_t row, std::uint32_t choice) const {
    return row != forbidding_row_ || forbidden_[place(choice)] != forbidding_now_;
  }

 private:
  std::size_t place(std::uint32_t choice) const {
    return choice == kNone ? forbidden_.size() - 1 : choice;
  }

  std::vector<std::uint64_t> open_;       // of each row: when it was opened; then of nobody
  std::vector<std::uint64_t> forbidden_;  // of each column, then of the outside option
  std::uint64_t now_ = 0;
  std::uint64_t forbidding_now_ = 0;
  std::uint32_t forbidding_row_ = kNone;
};

/// What is lost at least where a row chooses anything but what it has; +inf if it cannot.
struct LeastLoss {
  double leaving;   ///< by the row: the least reduced cost of its other choices
  double entering;  ///< by whoever takes the column that it leaves, if it has one

  double sum() const { return leaving + entering; }
};

/// @param row  must be open.  O(pairs of it and of its column in the core).
LeastLoss least_loss(const RankingState& state,
                     const RankingCore& core,
                     const RankingSubproblem& subproblem,
                     std::uint32_t row);

}  // namespace nda::lap
