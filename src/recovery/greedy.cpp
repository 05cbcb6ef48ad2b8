#include "recovery/greedy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/reduced_costs.hpp"
#include "core/slices.hpp"
#include "recovery/packing_state.hpp"

namespace nda::recovery {

using core::ArcId;

namespace {

// Values below are rounding errors of the linear program.
constexpr double kNothing = 1e-6;

// What saves anything and still fits, in this order.
core::Packing take(const core::Component& component, std::span<const ArcId> order) {
  PackingState state(component);
  for (const ArcId a : order) {
    if (component.costs[a] < 0 && state.fits(a)) state.insert(a);
  }
  return state.packing();
}

}  // namespace

core::Packing greedy(const core::Component& component,
                     std::span<const double> key,
                     const core::Deadline& deadline) {
  std::vector<ArcId> order(component.num_arcs());
  std::iota(order.begin(), order.end(), 0u);
  const auto before = [&](ArcId a, ArcId b) { return key[a] != key[b] ? key[a] < key[b] : a < b; };
  if (!core::sort_until(deadline, order, before)) return {};
  return take(component, order);
}

core::Packing greedy(const core::Component& component,
                     std::span<const ArcId> arcs,
                     std::span<const double> key) {
  std::vector<std::uint32_t> order(arcs.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t m, std::uint32_t n) {
    return key[m] != key[n] ? key[m] < key[n] : m < n;
  });
  return take(component, core::at_positions(arcs, order));
}

core::Packing dual_greedy(const core::Component& component,
                          std::span<const double> u,
                          const core::Deadline& deadline) {
  std::vector<double> key(component.num_arcs());
  core::reduced_costs(component, u, 0, key);
  for (ArcId a = 0; a < key.size(); ++a) key[a] += kTieBreak * component.costs[a];
  return greedy(component, key, deadline);
}

core::Packing round_values(const core::Component& component,
                           std::span<const ArcId> arcs,
                           std::span<const double> values) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    if (values[k] > kNothing) order.push_back(k);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) {
    if (values[k] != values[l]) return values[k] > values[l];
    const double difference = component.costs[arcs[k]] - component.costs[arcs[l]];
    return difference != 0 ? difference < 0 : arcs[k] < arcs[l];
  });
  PackingState state(component);
  for (const std::size_t k : order) {
    if (state.fits(arcs[k])) state.insert(arcs[k]);
  }
  return state.packing();
}

}  // namespace nda::recovery
