#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"

namespace nda::bounded {

/// What a branch says of an arc.
enum class Use : std::uint8_t { kFree, kNever, kAlways };

/// What cuts sum of g x <= right side with duals w <= 0 do to a bound.
struct CutPrices {
  std::vector<double> charge;  ///< [arc]: sum of w g; none without cuts
  double constant = 0;         ///< sum of w times right sides
  std::size_t num_cuts = 0;    ///< terms that these sums may have
};

/// r_a = c'[a] - sum of u over the indices of a, and a bound on what computing it rounded off.
struct ReducedCost {
  double value;
  double error;
};
/// With cuts, what they charge the arc is taken off, too.
ReducedCost reduced_cost_and_error(const core::Component& graph,
                                   std::span<const double> u,
                                   const CutPrices& cuts,
                                   core::ArcId a);

/// What multipliers prove, whatever they are (Theorem 4.1 with bounds):
///
///     L(u) = sum over indices of min over 0 <= n <= hi of f(n) + u n
///          + sum over free arcs of min(0, r_a) + sum over arcs that must be used of r_a,
///     r_a = c'[a] - sum of u over the indices of a,                          <=  cost of any
///     choice.
///
/// Cuts charge r_a, and add their constant.  Rounding is taken off: this is a bound in exact
/// arithmetic on the costs as they are.  Cost: O(A N).
/// @param u     by slot, those of the dummies 0
/// @param uses  by arc, or empty: all free
double lagrangian_bound(const BoundedComponent& component,
                        std::span<const double> u,
                        std::span<const Use> uses = {},
                        const CutPrices& cuts = {});

/// Puts every multiplier to where it proves no less and does nothing absurd; those of dummies to 0.
void clamp(const BoundedComponent& component, std::span<double> u);

}  // namespace nda::bounded
