#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::relax {

/// Multipliers of a component together with the reduced costs of its arcs, both kept up to date:
/// coordinate ascent of the separable dual (separable_dual.hpp) at two passes over a column of
/// indices for a dimension, where SeparableDual computes every reduced cost anew.
class Ascent {
 public:
  /// u by slot, <= 0.  Keeps a reference to the component.
  Ascent(const core::Component& component, std::vector<double> u);

  /// SeparableDual::ascend() of every dimension, last to first.  Cost: O(A N).
  void sweep();

  /// Lifts or lowers every multiplier to the highest value that its index allows, dimension by
  /// dimension, last to first, of the indices marked, or of all where `marked` is empty.  Of all:
  /// the multipliers are then feasible (as make_feasible() makes them).  Cost: O(A N).
  void tighten(std::span<const char> marked = {});

  /// Makes multipliers feasible that nearly are: each arc of negative reduced cost lowers the
  /// multiplier of one index by as much, the index that most such arcs share.  Cost: O(A), and
  /// O(N) for each of these.
  void repair();

  const std::vector<double>& u() const { return u_; }
  std::span<const double> reduced_costs() const { return r_; }
  /// sum of u: a lower bound where they are feasible.
  double bound() const;

 private:
  void move(std::size_t k);

  const core::Component& component_;
  std::vector<double> u_;
  std::vector<double> r_;       // [arc]
  std::vector<double> least_;   // of a dimension, by index: cheapest use
  std::vector<double> second_;  // and the one after it; then how far the multiplier moves
};

}  // namespace nda::relax
