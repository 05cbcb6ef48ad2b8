#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "bounded/bound.hpp"
#include "bounded/bounded_component.hpp"
#include "cutting/cut.hpp"
#include "lp/linear_program.hpp"

namespace nda::bounded {

/// The linear relaxation over some of a component's arcs:
///
///     minimise   sum of c' x + sum of single y   so that   on every index   sum of x + y - z = lo,
///                0 <= x <= 1,  0 <= y <= lo,  0 <= z <= hi - lo.
///
/// It always has a solution, x = 0.
class RelaxedProgram {
 public:
  /// Without arcs.  Keeps a reference to the component.
  explicit RelaxedProgram(const BoundedComponent& component);

  /// Arcs that are not there yet; free.
  void add_arcs(std::span<const core::ArcId> arcs);
  bool has(core::ArcId a) const { return column_[a] >= 0; }
  /// A row sum of coefficients * x <= right side over arcs that are there.
  void add_cut(std::span<const cutting::CutEntry> entries, double right_side);
  /// What is to become of an arc that is there.
  void fix(core::ArcId a, Use use);

  /// After arcs were added.
  lp::Outcome solve_primal(const core::Deadline& deadline);
  /// After arcs were fixed or freed; may end as soon as the value exceeds the limit.
  lp::Outcome solve_dual(const core::Deadline& deadline, double limit);

  /// By slot, clamped.
  std::vector<double> multipliers() const;
  /// Of the cut that was added as number c; <= 0.
  double cut_dual(std::size_t c) const {
    return std::min(0.0, program_.dual()[num_indices_ + c]) / scale_;
  }
  /// How much of an arc the solution uses; 0 of one that is not there.
  double use(core::ArcId a) const {
    return has(a) ? program_.primal()[static_cast<std::size_t>(column_[a])] : 0.0;
  }

 private:
  const BoundedComponent& component_;
  lp::LinearProgram program_;
  const double scale_;  // costs in the program are so many times those of the component
  std::size_t num_indices_ = 0;
  std::vector<int> row_;     // [slot], -1 of dummies
  std::vector<int> column_;  // [arc], -1 where it is not there
};

}  // namespace nda::bounded
