#include "bounded/relaxed_program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lp/cost_scale.hpp"

namespace nda::bounded {

using core::ArcId;

namespace {

// What costs are multiplied by in the linear program.
double scale_of(const BoundedComponent& component) {
  double single = 0;
  for (const Row& row : component.rows) single = std::max(single, std::abs(row.single));
  return lp::cost_scale(core::largest_cost(component.graph), single);
}

}  // namespace

RelaxedProgram::RelaxedProgram(const BoundedComponent& component)
    : component_(component),
      scale_(scale_of(component)),
      row_(component.rows.size(), -1),
      column_(component.num_arcs(), -1) {
  core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
    row_[slot] = program_.num_rows();
    program_.add_row({}, component.rows[slot].lo);
  });
  num_indices_ = static_cast<std::size_t>(program_.num_rows());
  for (int row = 0; row < program_.num_rows(); ++row) program_.set_equality(row, true);
  core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
    const Row& row = component.rows[slot];
    const std::array<int, 1> index = {row_[slot]};
    constexpr std::array<double, 1> kMore = {1.0};
    constexpr std::array<double, 1> kLess = {-1.0};
    if (row.lo > 0) program_.add_column({index, kMore}, row.single * scale_, row.lo);
    if (row.hi > row.lo) program_.add_column({index, kLess}, 0.0, row.hi - row.lo);
  });
}

void RelaxedProgram::add_arcs(std::span<const ArcId> arcs) {
  std::vector<int> index;
  std::vector<double> ones;
  for (const ArcId a : arcs) {
    index.clear();
    core::for_each_slot(
        component_.graph, a, [&](std::uint32_t slot) { index.push_back(row_[slot]); });
    ones.assign(index.size(), 1.0);
    column_[a] = program_.num_columns();
    program_.add_column({index, ones}, component_.graph.costs[a] * scale_, 1.0);
  }
}

void RelaxedProgram::add_cut(std::span<const cutting::CutEntry> entries, double right_side) {
  std::vector<int> index;
  std::vector<double> value;
  for (const cutting::CutEntry& entry : entries) {
    index.push_back(column_[entry.arc]);
    value.push_back(entry.coefficient);
  }
  program_.add_row({index, value}, right_side);
}

void RelaxedProgram::fix(ArcId a, Use use) {
  program_.set_lower(column_[a], use == Use::kAlways ? 1.0 : 0.0);
  program_.set_upper(column_[a], use == Use::kNever ? 0.0 : 1.0);
}

lp::Outcome RelaxedProgram::solve_primal(const core::Deadline& deadline) {
  return program_.solve_primal(deadline);
}

lp::Outcome RelaxedProgram::solve_dual(const core::Deadline& deadline, double limit) {
  return program_.solve_dual(deadline, limit * scale_, std::numeric_limits<int>::max());
}

std::vector<double> RelaxedProgram::multipliers() const {
  std::vector<double> u(row_.size(), 0.0);
  const std::span<const double> dual = program_.dual();
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    if (row_[slot] >= 0) u[slot] = dual[static_cast<std::size_t>(row_[slot])] / scale_;
  }
  clamp(component_, u);
  return u;
}

}  // namespace nda::bounded
