#include "relax/ascent.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/min_max.hpp"

namespace nda::relax {

using core::ArcId;

Ascent::Ascent(const core::Component& component,
               std::span<const ArcId> arcs,
               std::vector<double> u,
               double share)
    : share_(share), u_(std::move(u)), r_(arcs.size()) {
  const std::size_t dimensions = component.sizes.size();
  std::vector<std::uint32_t> slots(arcs.size() * dimensions);
  for (std::size_t n = 0; n < arcs.size(); ++n) r_[n] = component.costs[arcs[n]];
  for (std::size_t k = 0; k < dimensions; ++k) {
    const Index* const index = component.indices[k].data();
    for (std::size_t n = 0; n < arcs.size(); ++n) {
      const std::uint32_t slot = component.offset[k] + index[arcs[n]];
      slots[n * dimensions + k] = slot;
      r_[n] -= u_[slot];
    }
  }
  arcs_of_ = core::Lists<std::uint32_t>(component.num_slots(), [&](auto&& visit) {
    auto slot = slots.begin();
    for (std::uint32_t n = 0; n < arcs.size(); ++n) {
      for (std::size_t k = 0; k < dimensions; ++k) visit(*slot++, n);
    }
  });
  for (std::size_t k = dimensions; k-- > 0;) {
    const std::uint32_t dummy = component.offset[k];
    for (std::uint32_t slot = dummy + 1; slot <= dummy + component.sizes[k]; ++slot) {
      if (!arcs_of_[slot].empty())
        order_.push_back(slot);
      else
        u_[slot] = 0;
    }
  }
}

double Ascent::sweep(double least_move) {
  double most = 0;
  for (const std::uint32_t slot : order_) {
    double least = kInfinity;
    double second = kInfinity;
    for (const std::uint32_t n : arcs_of_[slot]) {
      second = core::min_of(second, core::max_of(least, r_[n]));
      least = core::min_of(least, r_[n]);
    }
    const double use = u_[slot] + least;
    const double next = std::min(0.0, u_[slot] + second);
    const double by = (use < 0 ? (1 - share_) * use + share_ * next : 0.0) - u_[slot];
    if (std::abs(by) <= least_move) continue;
    most = std::max(most, std::abs(by));
    move(slot, by);
  }
  return most;
}

void Ascent::climb(int max_sweeps, double least_move, const core::Deadline& deadline) {
  while (max_sweeps-- > 0 && !deadline.reached() && sweep(least_move) > 0) {
  }
}

void Ascent::tighten() {
  for (const std::uint32_t slot : order_) {
    double least = kInfinity;
    for (const std::uint32_t n : arcs_of_[slot]) least = core::min_of(least, r_[n]);
    const double by = std::min(0.0, u_[slot] + least) - u_[slot];
    if (by != 0) move(slot, by);
  }
}

void Ascent::move(std::uint32_t slot, double by) {
  u_[slot] += by;
  for (const std::uint32_t n : arcs_of_[slot]) r_[n] -= by;
}

double Ascent::bound() const {
  return std::accumulate(u_.begin(), u_.end(), 0.0);
}

}  // namespace nda::relax
