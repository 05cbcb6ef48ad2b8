#include "relax/ascent.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"

namespace nda::relax {

using core::ArcId;

Ascent::Ascent(const core::Component& component, std::vector<double> u)
    : component_(component), u_(std::move(u)), r_(component.num_arcs()) {
  core::reduced_costs(component, u_, 0, r_);
}

void Ascent::sweep() {
  for (std::size_t k = component_.sizes.size(); k-- > 0;) {
    const Index* const index = component_.indices[k].data();
    least_.assign(component_.sizes[k] + std::size_t{1}, kInfinity);
    second_.assign(least_.size(), kInfinity);
    for (ArcId a = 0; a < r_.size(); ++a) {
      double& least = least_[index[a]];
      double& second = second_[index[a]];
      second = core::min_of(second, core::max_of(least, r_[a]));
      least = core::min_of(least, r_[a]);
    }
    const std::span<double> block = std::span(u_).subspan(component_.offset[k], least_.size());
    for (std::size_t i = 1; i < block.size(); ++i) {
      const double use = block[i] + least_[i];
      const double next = block[i] + second_[i];
      const double value = use < 0 ? 0.5 * (use + std::min(0.0, next)) : 0.0;
      second_[i] = value - std::exchange(block[i], value);
    }
    move(k);
  }
}

void Ascent::tighten(std::span<const char> marked) {
  for (std::size_t k = component_.sizes.size(); k-- > 0;) {
    const std::size_t first = component_.offset[k];
    const std::size_t size = component_.sizes[k] + std::size_t{1};
    if (!marked.empty()) {
      const auto flags = marked.subspan(first, size);
      if (std::find(flags.begin() + 1, flags.end(), 1) == flags.end()) continue;
    }
    const Index* const index = component_.indices[k].data();
    least_.assign(size, kInfinity);
    for (ArcId a = 0; a < r_.size(); ++a) least_[index[a]] = core::min_of(least_[index[a]], r_[a]);
    second_.assign(size, 0.0);
    for (std::size_t i = 1; i < size; ++i) {
      if (!marked.empty() && !marked[first + i]) continue;
      const double value = std::min(0.0, u_[first + i] + least_[i]);
      second_[i] = value - std::exchange(u_[first + i], value);
    }
    move(k);
  }
}

// By second_, of the multipliers of dimension k.
void Ascent::move(std::size_t k) {
  second_[0] = 0;
  const Index* const index = component_.indices[k].data();
  for (ArcId a = 0; a < r_.size(); ++a) r_[a] -= second_[index[a]];
}

void Ascent::repair() {
  std::vector<ArcId> violated;
  for (ArcId a = 0; a < r_.size(); ++a) {
    if (r_[a] < 0) violated.push_back(a);
  }
  if (violated.empty()) return;
  std::vector<std::uint32_t> count(u_.size(), 0);
  for (const ArcId a : violated)
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { ++count[slot]; });
  for (const ArcId a : violated) {
    const double r = core::reduced_cost(component_, u_, a);
    if (r >= 0) continue;
    std::uint32_t busiest = 0;
    core::for_each_slot(component_, a, [&](std::uint32_t slot) {
      if (count[slot] > count[busiest]) busiest = slot;
    });
    u_[busiest] += r;
  }
  core::reduced_costs(component_, u_, 0, r_);
}

double Ascent::bound() const {
  return std::accumulate(u_.begin(), u_.end(), 0.0);
}

}  // namespace nda::relax
