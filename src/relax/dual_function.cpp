#include "relax/dual_function.hpp"

#include <algorithm>
#include <numeric>

#include "assign2d/side.hpp"

// For m = 2 rows and columns of the assignment have outside options instead of dummies that may
// repeat: fewer nodes, same optimum.

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;

constexpr std::uint32_t kNoCell = ~std::uint32_t{0};

}  // namespace

// The two-dimensional problem: its structure is that of the cells and stays fixed, its costs
// change.
struct DualFunction::Assignment {
  const core::Deadline deadline;
  const std::function<bool()> stop = [this] { return deadline.reached(); };
  std::unique_ptr<Assign2dSolver> solver;
  Assign2dResult result;
  std::vector<std::uint32_t> row_start;
  std::vector<std::uint32_t> column;
  std::vector<double> cost;
  std::vector<double> row_outside;
  std::vector<double> column_outside;
  std::vector<std::uint32_t> first_cell;   // [row]: that of its first pair; the others follow
  std::vector<std::uint32_t> former_pair;  // [row]
  std::vector<std::uint32_t> row_cell;     // [row]: cell (i1, 0) or kNoCell
  std::vector<std::uint32_t> column_cell;  // [column]: cell (0, i2) or kNoCell

  Assignment(const Component& component,
             const Cells& cells,
             Assign2dMethod method,
             const core::Deadline& solve_until)
      : deadline(solve_until),
        solver(make_assign2d_solver(method)),
        row_outside(component.sizes[0], 0.0),
        column_outside(component.sizes[1], 0.0),
        first_cell(component.sizes[0], 0),
        former_pair(component.sizes[0], 0),
        row_cell(component.sizes[0], kNoCell),
        column_cell(component.sizes[1], kNoCell) {
    row_start.assign(component.sizes[0] + std::size_t{1}, 0);
    for (std::uint32_t cell = 0; cell < cells.num_cells(); ++cell) {
      const Index i = cells.row[cell];
      const Index j = cells.column[cell];
      if (i == 0) {
        column_cell[j - 1] = cell;
      } else if (j == 0) {
        row_cell[i - 1] = cell;
      } else {
        if (row_start[i]++ == 0) first_cell[i - 1] = cell;
        column.push_back(j - 1);
      }
    }
    for (std::size_t i = 1; i < row_start.size(); ++i) row_start[i] += row_start[i - 1];
    cost.resize(column.size());
    solver->set_stop(&stop);
  }

  // False if it was interrupted.
  bool solve(std::span<const double> d) {
    for (std::size_t i = 0; i < row_cell.size(); ++i) {
      const std::size_t size = row_start[i + 1] - row_start[i];
      std::copy_n(d.begin() + first_cell[i], size, cost.begin() + row_start[i]);
      if (row_cell[i] != kNoCell) row_outside[i] = std::min(0.0, d[row_cell[i]]);
    }
    for (std::size_t j = 0; j < column_cell.size(); ++j) {
      if (column_cell[j] != kNoCell) column_outside[j] = std::min(0.0, d[column_cell[j]]);
    }
    try {
      solver->solve_warm({row_start, column, cost, row_outside, column_outside}, result);
    } catch (const Assign2dInterrupted&) {
      result.cost = std::accumulate(result.u.begin(), result.u.end(), 0.0);
      result.cost = std::accumulate(result.v.begin(), result.v.end(), result.cost);
      return false;
    }
    return true;
  }

  // The cell of a pair, most often the same as the last time.
  std::uint32_t cell(std::uint32_t row, std::uint32_t wanted) {
    std::uint32_t& pair = former_pair[row];
    pair = lap::find_pair(row_start, column, row, wanted, pair);
    return first_cell[row] + (pair - row_start[row]);
  }
};

DualFunction::DualFunction(const Component& component,
                           Assign2dMethod method,
                           const core::Deadline& deadline)
    : RelaxedDual(component, 2),
      assignment_(std::make_unique<Assignment>(component, cells(), method, deadline)) {}

DualFunction::~DualFunction() = default;

RelaxedDual::KeptValue DualFunction::solve_kept(std::span<const double> costs,
                                                std::vector<std::uint32_t>& chosen) {
  const bool solved = assignment_->solve(costs);
  for_each_chosen_cell(assignment_->result, [&](std::uint32_t cell) { chosen.push_back(cell); });
  return {assignment_->result.cost, assignment_->result.cost, !solved};
}

// Pairs, and the cells of rows and columns that stay out where that pays.
template <typename Visit>
void DualFunction::for_each_chosen_cell(const Assign2dResult& answer, Visit&& visit) const {
  Assignment& assignment = *assignment_;
  for (std::uint32_t row = 0; row < assignment.row_cell.size(); ++row) {
    if (answer.column_of_row[row] != kUnassigned) {
      visit(assignment.cell(row, static_cast<std::uint32_t>(answer.column_of_row[row])));
    } else if (assignment.row_outside[row] < 0) {
      visit(assignment.row_cell[row]);
    }
  }
  for (std::uint32_t column = 0; column < assignment.column_cell.size(); ++column) {
    const bool outside = answer.row_of_column[column] == kUnassigned;
    if (outside && assignment.column_outside[column] < 0) visit(assignment.column_cell[column]);
  }
}

Assign2dProblem DualFunction::assignment() const {
  const Assignment& a = *assignment_;
  return {a.row_start, a.column, a.cost, a.row_outside, a.column_outside};
}

std::vector<std::uint32_t> DualFunction::cells_of(const Assign2dResult& answer) const {
  std::vector<std::uint32_t> cells;
  for_each_chosen_cell(answer, [&](std::uint32_t cell) { cells.push_back(cell); });
  return cells;
}

void DualFunction::kept_multipliers(std::span<double> all) const {
  const Assign2dResult& result = assignment_->result;
  const std::vector<std::uint32_t>& offset = component().offset;
  std::copy(result.u.begin(), result.u.end(), all.begin() + offset[0] + 1);
  std::copy(result.v.begin(), result.v.end(), all.begin() + offset[1] + 1);
}

}  // namespace nda::relax
