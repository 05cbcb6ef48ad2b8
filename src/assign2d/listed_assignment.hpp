#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/side.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// Row takes column (kNone: its outside option) at that cost.
struct RowChange {
  std::uint32_t row;
  std::uint32_t column;
  double cost;
};

/// An assignment that turns into others by changing some rows, and back.
class ListedAssignment {
 public:
  /// Becomes `best`.
  /// @param problem, best  must outlive this.
  void start(const Assign2dProblem& problem, const Assign2dResult& best);

  /// Makes the changes, and leaves in them what takes them back.  No row comes twice.
  void exchange(std::span<RowChange> changes);

  /// Writes assignment and cost, which is summed afresh, with the duals of the best.  O(rows +
  /// columns).
  void write(Assign2dResult& result) const;
  bool is_in(const Assign2dResult& result) const;

 private:
  std::span<const double> column_outside_;
  const Assign2dResult* best_ = nullptr;
  std::vector<std::int32_t> column_of_row_;
  std::vector<double> row_cost_;  // of the choice of each row
};

}  // namespace nda::lap
