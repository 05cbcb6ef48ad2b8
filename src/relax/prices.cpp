#include "relax/prices.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"

namespace nda::relax {

using core::ArcId;

Prices::Prices(const core::Component& component, std::vector<double> u)
    : component_(component), r_(component.num_arcs()) {
  set(std::move(u));
}

void Prices::set(std::vector<double> u) {
  u_ = std::move(u);
  core::reduced_costs(component_, u_, 0, r_);
}

void Prices::tighten(std::span<const char> marked) {
  std::vector<double> least;
  for (std::size_t k = component_.sizes.size(); k-- > 0;) {
    const std::size_t size = component_.sizes[k] + std::size_t{1};
    const auto marks = marked.subspan(component_.offset[k], size);
    if (std::find(marks.begin() + 1, marks.end(), 1) == marks.end()) continue;
    const Index* const index = component_.indices[k].data();
    least.assign(size, kInfinity);
    for (ArcId a = 0; a < r_.size(); ++a) least[index[a]] = core::min_of(least[index[a]], r_[a]);
    std::vector<double>& moved = least;  // by how much
    moved[0] = 0;
    for (std::size_t i = 1; i < size; ++i) {
      double& u = u_[component_.offset[k] + i];
      const double value = marks[i] ? std::min(0.0, u + least[i]) : u;
      moved[i] = value - std::exchange(u, value);
    }
    for (ArcId a = 0; a < r_.size(); ++a) r_[a] -= moved[index[a]];
  }
}

void Prices::repair() {
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

double Prices::bound() const {
  return std::accumulate(u_.begin(), u_.end(), 0.0);
}

}  // namespace nda::relax
