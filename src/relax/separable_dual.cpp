#include "relax/separable_dual.hpp"

#include <algorithm>

#include "core/reduced_costs.hpp"

// Coordinate ascent on the fully relaxed dual is min-marginal averaging: with everything else
// fixed, q as a function of u_i rises with slope 1 up to the cheapest use of index i, is flat up to
// the second cheapest, and falls beyond.  The middle of the flat part leaves room to both sides,
// which the ends do not.  It stalls at kinks, 0.1 to 16 % below the maximum on tracking problems;
// see docs/nonsmooth.md.

namespace nda::relax {

using core::ArcId;

double SeparableDual::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::fill(subgradient.begin(), subgradient.end(), 0.0);
  double value = 0;
  core::for_each_reduced_cost(component_, u, {}, [&](ArcId a, double r) {
    if (r >= 0) return;
    value += r;
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { subgradient[slot] -= 1.0; });
  });
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    value += std::min(0.0, u[slot]);
    if (u[slot] < 0 || (u[slot] == 0 && subgradient[slot] < 0)) subgradient[slot] += 1.0;
  }
  for (const std::uint32_t dummy : component_.offset) subgradient[dummy] = 0.0;
  return value;
}

double SeparableDual::ascend(std::size_t block, std::span<double> u) {
  const core::Column& index = component_.indices[block];
  const std::span<double> values =
      u.subspan(component_.offset[block], component_.sizes[block] + std::size_t{1});
  best_.assign(values.size(), 0.0);
  second_.assign(values.size(), kInfinity);
  double before = 0;
  core::for_each_reduced_cost(component_, u, {}, [&](ArcId a, double r) {
    const Index i = index[a];
    if (i == 0) return;
    before += std::min(0.0, r);
    const double use = r + values[i];
    if (use < best_[i]) {
      second_[i] = best_[i];
      best_[i] = use;
    } else {
      second_[i] = std::min(second_[i], use);
    }
  });
  double after = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    before += std::min(0.0, values[i]);
    // With the index best left alone, 0 is the first use and any value up to the second is as good
    // as 0.
    values[i] = best_[i] < 0 ? 0.5 * (best_[i] + std::min(0.0, second_[i])) : 0.0;
    after += best_[i];
  }
  return std::max(0.0, after - before);
}

}  // namespace nda::relax
