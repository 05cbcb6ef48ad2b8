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
  /// Before anything else: no row is open, nothing forbidden.
  void resize(std::uint32_t num_rows, std::uint32_t num_columns) {
    open_.assign(num_rows + 1, 0);
    forbidden_.assign(num_columns + 1, 0);
    now_ = 0;
  }
  /// The same, in constant time.
  void clear() {
    open_.back() = ++now_;
    forbidding_row_ = kNone;
  }
  void open(std::uint32_t row) { open_[row] = now_; }
  /// All that is forbidden must be forbidden to the same row.
  void forbid(std::uint32_t row, std::uint32_t choice) {
    forbidding_row_ = row;
    forbidden_[place(choice)] = now_;
  }

  /// Also true of RankingState::nobody(): a column that has no row is there to be taken.
  bool is_open(std::uint32_t row) const { return open_[row] == now_; }
  bool forbids(std::uint32_t row) const { return row == forbidding_row_; }
  /// choice: a column, or kNone for the outside option.
  bool allows(std::uint32_t row, std::uint32_t choice) const {
    return row != forbidding_row_ || forbidden_[place(choice)] != now_;
  }

 private:
  std::size_t place(std::uint32_t choice) const {
    return choice == kNone ? forbidden_.size() - 1 : choice;
  }

  std::vector<std::uint64_t> open_;       // of each row: when it was opened; then of nobody
  std::vector<std::uint64_t> forbidden_;  // of each column, then of the outside option
  std::uint64_t now_ = 0;
  std::uint32_t forbidding_row_ = kNone;
};

/// At least so much is lost where `row`, which must be open, chooses anything but what it has: the
/// least reduced cost of its other choices, and that of the others who could take the column it
/// leaves.  +inf if there are none.  O(pairs of both in the core).
double least_loss(const RankingState& state,
                  const RankingCore& core,
                  const RankingSubproblem& subproblem,
                  std::uint32_t row);

}  // namespace nda::lap
