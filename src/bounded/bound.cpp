#include "bounded/bound.hpp"

#include <cmath>

#include "core/double_double.hpp"

namespace nda::bounded {

using core::ArcId;

namespace {

constexpr double kUlp = 0x1p-53;

}  // namespace

ReducedCost reduced_cost_and_error(const core::Component& graph,
                                   std::span<const double> u,
                                   const CutPrices& cuts,
                                   ArcId a) {
  const double charge = cuts.charge.empty() ? 0.0 : cuts.charge[a];
  double r = graph.costs[a] - charge;
  double magnitude = std::abs(graph.costs[a]) + std::abs(charge);
  for (int k = 0; k < graph.num_dimensions(); ++k) {
    const double multiplier = u[graph.slot(k, a)];
    r -= multiplier;
    magnitude += std::abs(multiplier);
  }
  // Each subtraction, and each addition to the charge, whose terms have one sign, rounds off at
  // most an ulp of a partial sum; twice more for the first and for the sum of sizes.
  const double operations = graph.num_dimensions() + 2 + 2 * static_cast<double>(cuts.num_cuts);
  return {r, operations * kUlp * magnitude};
}

double lagrangian_bound(const BoundedComponent& component,
                        std::span<const double> u,
                        std::span<const Use> uses,
                        const CutPrices& cuts) {
  core::DoubleDouble sum;
  double magnitude = 0;
  const auto add = [&](double term) {
    sum.add(term);
    magnitude += std::abs(term);
  };
  for (std::size_t slot = 0; slot < component.rows.size(); ++slot) {
    const Row& row = component.rows[slot];
    const double value = row.value(u[slot]);
    if (value != 0) add(value - 2 * kUlp * std::abs(value));
  }
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const Use use = uses.empty() ? Use::kFree : uses[a];
    if (use == Use::kNever) continue;
    const ReducedCost r = reduced_cost_and_error(component.graph, u, cuts, a);
    const double least = r.value - r.error;
    if (use == Use::kAlways || least < 0) add(least);
  }
  add(cuts.constant - 2 * static_cast<double>(cuts.num_cuts) * kUlp * std::abs(cuts.constant));
  return std::nextafter(sum.high() - 2 * kUlp * std::abs(sum.high()) - 0x1p-90 * magnitude,
                        -kInfinity);
}

void clamp(const BoundedComponent& component, std::span<double> u) {
  for (std::size_t slot = 0; slot < component.rows.size(); ++slot)
    u[slot] = component.rows[slot].clamped(u[slot]);
  for (const std::uint32_t dummy : component.graph.offset) u[dummy] = 0;
}

}  // namespace nda::bounded
