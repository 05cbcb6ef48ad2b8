#pragma once

#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "core/lists.hpp"
#include "dual/concave_function.hpp"

namespace nda::bounded {

/// The Lagrangian dual of a component with all dimensions relaxed:
///
///     q(u) = sum over indices of min over 0 <= n <= hi of f(n) + u n  +  sum over arcs of min(0,
///     r_a).
///
/// Variables are all slots, those of the dummies must be 0.  Its maximum is the value of the linear
/// relaxation.  A block is a dimension, whose indices share no arc.
class SeparableDual : public dual::CoordinateFunction {
 public:
  /// Keeps a reference to the component.
  explicit SeparableDual(const BoundedComponent& component);

  std::size_t num_variables() const override { return component_.rows.size(); }
  /// Cost: O(A N).
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  std::size_t num_blocks() const override { return component_.graph.sizes.size(); }
  /// Puts every u_i of a dimension between the arc that is the last to be used and the one after
  /// it, or to 0 where no bound holds.  Cost: O(A (N + log A)).
  double ascend(std::size_t block, std::span<double> u) override;

 private:
  const BoundedComponent& component_;
  core::Lists<core::ArcId> arcs_;  // [slot]
  std::vector<double> cost_;       // of the arcs of a slot, without what the slot itself asks
};

}  // namespace nda::bounded
