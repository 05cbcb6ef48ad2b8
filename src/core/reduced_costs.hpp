#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/slices.hpp"

namespace nda::core {

/// Reduced costs of the arcs first, first + 1, ...: r[n] = c'[a] - sum over k of u[slot(k, a)] with
/// a = first + n and k from `from_dimension` on, subtracted in the order of dimensions: the same
/// bits as reduced_cost() gives where u of the dimensions left out is 0.  u has num_slots()
/// entries. Cost: about one load of an index and one of a multiplier per arc and dimension.
void reduced_costs(const Component& component,
                   std::span<const double> u,
                   ArcId first,
                   std::span<double> r,
                   int from_dimension = 0);

/// Arcs whose reduced costs are computed together: they stay in the first-level cache.
inline constexpr std::size_t kReducedBlock = 512;
static_assert(kSlice % kReducedBlock == 0);

/// Calls visit(a, r) with the reduced cost r of every arc a, in order, looking at the clock before
/// every slice; false if the deadline cut it short.
template <typename Visit>
bool for_each_reduced_cost(const Component& component,
                           std::span<const double> u,
                           const Deadline& deadline,
                           Visit&& visit) {
  std::array<double, kReducedBlock> buffer;
  const std::size_t num_arcs = component.num_arcs();
  for (std::size_t first = 0; first < num_arcs; first += kReducedBlock) {
    if (first % kSlice == 0 && deadline.reached()) return false;
    const std::span<double> r(buffer.data(), std::min(kReducedBlock, num_arcs - first));
    reduced_costs(component, u, static_cast<ArcId>(first), r);
    for (std::size_t n = 0; n < r.size(); ++n) visit(static_cast<ArcId>(first + n), r[n]);
  }
  return true;
}

}  // namespace nda::core
