#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::relax {

/// Multipliers of a component together with the reduced costs of all its arcs.
class Prices {
 public:
  /// u by slot, <= 0.  Keeps a reference to the component.  Cost: O(A N).
  Prices(const core::Component& component, std::vector<double> u);

  /// Other multipliers.
  void set(std::vector<double> u);

  /// Lifts or lowers every multiplier that is marked to the highest value that its index allows,
  /// dimension by dimension, last to first; where all are, the multipliers are then feasible.
  /// Cost: O(A) for every dimension with a mark.
  void tighten(std::span<const char> marked);

  /// Makes multipliers feasible that nearly are: each arc of negative reduced cost lowers the
  /// multiplier of one index by as much, the index that most such arcs share.  Cost: O(A), and
  /// O(N) for each of these; O(A N) if there are any.
  void repair();

  const std::vector<double>& u() const { return u_; }
  std::span<const double> reduced_costs() const { return r_; }
  /// sum of u: a lower bound where they are feasible.
  double bound() const;

 private:
  const core::Component& component_;
  std::vector<double> u_;
  std::vector<double> r_;  // [arc]
};

}  // namespace nda::relax
