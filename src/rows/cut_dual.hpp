#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "cutting/cut.hpp"
#include "dual/concave_function.hpp"
#include "nda/assign2d.hpp"
#include "relax/dual_function.hpp"

namespace nda::rows {

/// The Lagrangian dual of a component with cuts as more rows (docs/cuts.md): the multipliers u of
/// the relaxed indices, then one multiplier m for every cut.  A cut is a row like those of the
/// indices,
///
///     sum over arcs of coefficient * x  +  slack  =  right side,   0 <= slack <= right side,
///
/// so with its multiplier it charges the arcs that it is about, and for any u and m (no sign!)
///
///     q(u, m) = sum over cuts of right side * min(0, m)
///             + the dual function of the costs  c'[a] - sum over cuts of m * coefficient
///
/// is concave and q(u, m) <= optimum.  A subgradient counts uses, as for the indices: right side
/// minus what the chosen arcs use, minus the slack, which is all of the right side where m > 0.
class CutDual : public dual::ConcaveFunction {
 public:
  /// Without cuts at first.  Keeps a reference to the component.
  explicit CutDual(const core::Component& component,
                   Assign2dMethod method = Assign2dMethod::kShortestPath,
                   const core::Deadline& deadline = {});

  /// Other cuts, each with all its arcs of the component in `entries`; must outlive this, or the
  /// next call.  Their own multipliers do not count.
  void set_rows(std::span<const cutting::CutRow> rows) { rows_ = rows; }
  std::span<const cutting::CutRow> rows() const { return rows_; }

  std::size_t num_variables() const override { return function_.num_variables() + rows_.size(); }
  /// Variable j < num_indices_relaxed() stands for slot first_slot() + j, the others for cuts.
  std::size_t num_indices_relaxed() const { return function_.num_variables(); }
  std::uint32_t first_slot() const { return function_.first_slot(); }

  /// The same point, the same bits, whatever was evaluated before.  Cost: that of the dual function
  /// without cuts, and two passes over the arcs of cuts with m != 0.
  double evaluate(std::span<const double> point, std::span<double> subgradient) override;

  /// The arcs of the last relaxed solution: no kept index is used twice.
  std::span<const core::ArcId> chosen_arcs() const { return function_.chosen_arcs(); }

  /// Takes the multipliers of the last evaluation to where they prove its value or more: writes
  /// multipliers of all slots, <= 0, to `u` and min(0, m) of the cuts to `of_rows`; reduced costs
  /// are then >= 0 up to rounding, and cutting::price() says what that proves.  False where the
  /// deadline struck: neither is of use then.  Cost: relax::make_feasible().
  bool certify(std::span<double> u, std::span<double> of_rows, const core::Deadline& deadline);

 private:
  void charge(std::span<const double> multipliers);
  void forget_charges();

  const core::Component& component_;
  core::Component charged_;  // the same arcs, with costs that cuts have changed
  relax::DualFunction function_;
  std::span<const cutting::CutRow> rows_;
  std::vector<double> multipliers_;   // of the rows, at the last evaluation
  std::vector<core::ArcId> touched_;  // arcs whose cost is not that of the component
  std::vector<char> uses_;            // [arc]: 1 if chosen, 0 between evaluations
};

}  // namespace nda::rows
