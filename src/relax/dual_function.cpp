#include "relax/dual_function.hpp"

#include <algorithm>
#include <numeric>

#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"

// Report, sections 3.1 and 4.1, for m = 2, with three liberties.
//   - The problem is shifted, so that every index may stay uncovered at cost 0.  Rows and columns
//   of the
//     assignment then have outside options instead of dummies that may repeat: fewer nodes, same
//     optimum.
//   - Singletons of relaxed indices are relaxed with everything else; eq. (3.3) puts them into
//   c(0..0).  Their
//     part is closed: min(0, 0 - u_i) + u_i = min(0, u_i).  u needs no sign and no box.
//   - At u_i = 0 the singleton is indifferent; we use it exactly when no arc uses i, which gives
//   the subgradient
//     nearest to zero among its choices.

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
  std::vector<std::uint32_t> pair_cell;    // [pair]: its cell
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
        ++row_start[i];
        column.push_back(j - 1);
        pair_cell.push_back(cell);
      }
    }
    for (std::size_t i = 1; i < row_start.size(); ++i) row_start[i] += row_start[i - 1];
    cost.resize(column.size());
    solver->set_stop(&stop);
  }

  // False if it was interrupted.
  bool solve(std::span<const double> d) {
    for (std::size_t pair = 0; pair < cost.size(); ++pair) cost[pair] = d[pair_cell[pair]];
    for (std::size_t i = 0; i < row_cell.size(); ++i) {
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

  // The cell of a pair.
  std::uint32_t cell(std::uint32_t row, std::uint32_t wanted) const {
    const auto begin = column.begin() + row_start[row];
    const auto end = column.begin() + row_start[row + 1];
    return pair_cell[static_cast<std::size_t>(std::lower_bound(begin, end, wanted) -
                                              column.begin())];
  }
};

DualFunction::DualFunction(const Component& component,
                           Assign2dMethod method,
                           const core::Deadline& deadline)
    : component_(component),
      cells_(find_cells(component)),
      num_slots_(component.num_slots()),
      slot_u_(num_slots_, 0.0),
      d_(cells_.num_cells()),
      cell_from_(cells_.num_cells()),
      assignment_(std::make_unique<Assignment>(component, cells_, method, deadline)) {
  first_slot_ =
      component.num_dimensions() > 2 ? component.offset[2] : static_cast<std::uint32_t>(num_slots_);
}

DualFunction::~DualFunction() = default;

double DualFunction::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::copy(u.begin(), u.end(), slot_u_.begin() + first_slot_);
  collapse(component_, cells_, slot_u_, d_, cell_from_);
  interrupted_ = !assignment_->solve(d_);

  double value = assignment_->result.cost;
  for (const double multiplier : u) value += std::min(0.0, multiplier);
  std::fill(subgradient.begin(), subgradient.end(), 0.0);
  choose(subgradient);
  value += take_free_arcs(subgradient);
  for (std::size_t j = 0; j < u.size(); ++j) {
    const double uses = -subgradient[j];
    const double singleton = u[j] > 0 || (u[j] == 0 && uses == 0) ? 1.0 : 0.0;
    subgradient[j] = 1.0 - uses - singleton;
  }
  for (std::size_t k = 2; k < component_.sizes.size(); ++k) {
    subgradient[component_.offset[k] - first_slot_] = 0.0;
  }
  violation_ = std::inner_product(subgradient.begin(), subgradient.end(), subgradient.begin(), 0.0);
  return value;
}

// Pairs, and the cells of rows and columns that stay out where that pays.
template <typename Visit>
void DualFunction::for_each_chosen_cell(const Assign2dResult& answer, Visit&& visit) const {
  const Assignment& assignment = *assignment_;
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

// Collects the relaxed solution of the assignment (3.5); subgradient then holds minus the uses of
// its arcs.
void DualFunction::choose(std::span<double> subgradient) {
  chosen_.clear();
  aligned_cells_.clear();
  for_each_chosen_cell(assignment_->result,
                       [&](std::uint32_t cell) { take_cell(cell, subgradient); });
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

void DualFunction::take_cell(std::uint32_t cell, std::span<double> subgradient) {
  aligned_cells_.push_back(cell);
  const ArcId end = cells_.first_arc[cell + 1];
  use(cheapest_arc(component_, slot_u_, cell_from_[cell], end, d_[cell]), subgradient);
}

// Those of cell (0, 0).
double DualFunction::take_free_arcs(std::span<double> subgradient) {
  std::array<double, core::kReducedBlock> r;
  double value = 0;
  for (ArcId first = 0; first < cells_.num_free();) {
    const std::size_t count = std::min<std::size_t>(r.size(), cells_.num_free() - first);
    core::reduced_costs(component_, slot_u_, first, std::span(r).first(count), 2);
    for (std::size_t n = 0; n < count; ++n) {
      if (r[n] >= 0) continue;
      value += r[n];
      use(first + static_cast<ArcId>(n), subgradient);
    }
    first += static_cast<ArcId>(count);
  }
  return value;
}

void DualFunction::use(ArcId a, std::span<double> subgradient) {
  chosen_.push_back(a);
  for (int k = 2; k < component_.num_dimensions(); ++k) {
    subgradient[component_.slot(k, a) - first_slot_] -= 1.0;
  }
}

void DualFunction::multipliers(std::span<double> all) const {
  const Assign2dResult& result = assignment_->result;
  std::copy(result.u.begin(), result.u.end(), all.begin() + component_.offset[0] + 1);
  std::copy(result.v.begin(), result.v.end(), all.begin() + component_.offset[1] + 1);
  for (std::size_t slot = first_slot_; slot < num_slots_; ++slot) {
    all[slot] = std::min(0.0, slot_u_[slot]);
  }
  for (const std::uint32_t dummy : component_.offset) all[dummy] = 0.0;
}

// Reduced costs are computed again for every dimension rather than kept: that costs no more time
// than reading and writing them, and no memory.
double make_feasible(const Component& component,
                     std::span<double> u,
                     const core::Deadline& deadline) {
  std::vector<double> least_of;
  for (std::size_t k = component.sizes.size(); k-- > 0;) {
    const Index* index = component.indices[k].data();
    const std::span<double> block = u.subspan(component.offset[k], component.sizes[k] + 1);
    least_of.assign(block.size(), kInfinity);
    const std::span<double> least(least_of);
    const auto note = [least, index](ArcId a, double r) {
      least[index[a]] = core::min_of(least[index[a]], r);
    };
    if (!core::for_each_reduced_cost(component, u, deadline, note)) return -kInfinity;
    for (std::size_t i = 1; i < block.size(); ++i) block[i] = std::min(0.0, block[i] + least[i]);
  }
  double sum = 0;
  for (const double multiplier : u) sum += multiplier;
  return sum;
}

}  // namespace nda::relax
