#include "rows/cut_dual.hpp"

#include <algorithm>

#include "relax/relaxed_dual.hpp"

// For three indices of any dimensions the arcs that use two or more of them exclude each other
// (Balas & Saltzman 1991): such a clique is one more row, and so is every cut of rank 1.  A
// multiplier of an index charges its arcs, one of a cut charges the arcs of the cut; the dual
// function is then that of other costs, and nothing in it needs to know of cuts.
//
// Charges are not added to the last ones but to the costs themselves: so a point has one value,
// whatever came before it.

namespace nda::rows {
namespace {

using core::ArcId;
using core::Component;

// With borrowed indices and costs of its own.
Component with_own_costs(const Component& source) {
  Component copy;
  copy.sizes = source.sizes;
  copy.offset = source.offset;
  for (const core::Column& column : source.indices)
    copy.indices.push_back(core::Column::borrow({column.data(), column.size()}));
  copy.costs = source.costs;
  copy.dimensions = source.dimensions;
  copy.origin = source.origin;
  return copy;
}

}  // namespace

CutDual::CutDual(const Component& component, Assign2dMethod method, const core::Deadline& deadline)
    : component_(component),
      charged_(with_own_costs(component)),
      function_(charged_, method, deadline),
      uses_(component.num_arcs(), 0) {}

double CutDual::evaluate(std::span<const double> point, std::span<double> subgradient) {
  const std::size_t num_slots = num_indices_relaxed();
  const std::span<const double> m = point.subspan(num_slots);
  charge(m);
  double value = function_.evaluate(point.first(num_slots), subgradient.first(num_slots));
  for (const ArcId a : chosen_arcs()) uses_[a] = 1;
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    const double right_side = rows_[c].cut.right_side();
    value += right_side * std::min(0.0, m[c]);
    double left = right_side;
    for (const cutting::CutEntry& entry : rows_[c].entries)
      left -= uses_[entry.arc] * entry.coefficient;
    // What is left may be slack where that costs nothing.
    if (m[c] == 0) left -= std::clamp(left, 0.0, right_side);
    if (m[c] > 0) left -= right_side;
    subgradient[num_slots + c] = left;
  }
  for (const ArcId a : chosen_arcs()) uses_[a] = 0;
  return value;
}

void CutDual::charge(std::span<const double> multipliers) {
  forget_charges();
  multipliers_.assign(multipliers.begin(), multipliers.end());
  for (std::size_t c = 0; c < rows_.size(); ++c) {
    if (multipliers_[c] == 0) continue;
    for (const cutting::CutEntry& entry : rows_[c].entries) {
      charged_.costs[entry.arc] -= multipliers_[c] * entry.coefficient;
      touched_.push_back(entry.arc);
    }
  }
}

void CutDual::forget_charges() {
  for (const ArcId a : touched_) charged_.costs[a] = component_.costs[a];
  touched_.clear();
}

bool CutDual::certify(std::span<double> u,
                      std::span<double> of_rows,
                      const core::Deadline& deadline) {
  function_.multipliers(u);
  for (std::size_t c = 0; c < rows_.size(); ++c) of_rows[c] = std::min(0.0, multipliers_[c]);
  charge(of_rows);
  return relax::make_feasible(charged_, u, deadline) > -kInfinity;
}

}  // namespace nda::rows
