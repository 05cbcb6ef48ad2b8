#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"
#include "dual/concave_function.hpp"

namespace nda::relax {

/// The Lagrangian dual of a component with all dimensions relaxed (m = 0), a separable function:
///
///     q(u) = sum over real indices of min(0, u_i)  +  sum over arcs of min(0, c' - sum of u).
///
/// Variables are all slots, those of the dummies must be 0.  Its maximum is that of the dual
/// function with two sets kept (both are the value of the linear relaxation), an evaluation needs
/// no assignment.  A block is a dimension.
class SeparableDual : public dual::CoordinateFunction {
 public:
  /// Keeps a reference to the component.
  explicit SeparableDual(const core::Component& component) : component_(component) {}

  std::size_t num_variables() const override { return component_.num_slots(); }
  /// Cost: O(A N).
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  std::size_t num_blocks() const override { return component_.sizes.size(); }
  /// Puts every u_i of a dimension half way between the two cheapest uses of i (leaving it alone is
  /// one, at 0): any value between them is best.  Cost: O(A N).
  double ascend(std::size_t block, std::span<double> u) override;

 private:
  const core::Component& component_;
  std::vector<double> best_;    // cheapest use of every index of a dimension
  std::vector<double> second_;  // and the one after it
};

}  // namespace nda::relax
