#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "bounded/parts.hpp"
#include "core/random.hpp"

/// Small components with bounds of any kind, and their relaxed problems (3.2) by listing all
/// choices, without a collapse.
namespace nda::bounded {

/// 0..hi, 1..hi, lo..lo with singletons that cost or pay, lo..hi, some singletons forbidden.
inline Row random_row(core::Random& random, bool integer) {
  Row row;
  row.lo = static_cast<Index>(random.below(4));
  row.hi = row.lo + static_cast<Index>(random.below(3));
  row.single = random.uniform(row.lo == row.hi ? -6 : 0, 9);
  if (integer) row.single = static_cast<double>(static_cast<int>(row.single));
  if (random.below(6) == 0) {
    row.single = 300;
    row.is_forced = true;
  }
  return row;
}

/// Of two to six dimensions, three indices each and eight arcs at most; one in five with bounds of
/// 1..1 alone.
inline BoundedComponent small_component(std::uint64_t seed) {
  core::Random random(seed ^ 0x626f756e64ULL);
  std::vector<Index> sizes(2 + random.below(5));
  for (Index& size : sizes) size = 1 + static_cast<Index>(random.below(3));
  const bool integer = random.below(2) == 0;
  std::map<std::vector<Index>, double> arcs;
  for (std::uint64_t n = 1 + random.below(8); n > 0; --n) {
    std::vector<Index> tuple(sizes.size());
    for (std::size_t k = 0; k < tuple.size(); ++k)
      tuple[k] = random.below(4) == 0 ? 0 : 1 + static_cast<Index>(random.below(sizes[k]));
    if (std::count(tuple.begin(), tuple.end(), 0u) == static_cast<std::ptrdiff_t>(tuple.size()))
      continue;
    const double cost = random.uniform(-9, 4);
    arcs[tuple] = integer ? static_cast<double>(static_cast<int>(cost)) : cost;
  }
  BoundedComponent component{core::make_component(sizes), {}};
  for (const auto& [tuple, cost] : arcs) core::append_arc(component.graph, tuple, cost);
  component.rows.resize(component.graph.num_slots());
  const bool once = random.below(5) == 0;
  core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
    component.rows[slot] =
        once ? Row{random.uniform(0, 9), 1, 1, false, false} : random_row(random, integer);
  });
  fit_rows(component);
  return component;
}

/// c' less the multipliers of relaxed dimensions.
inline double reduced(const BoundedComponent& component,
                      int num_kept,
                      std::span<const double> u,
                      core::ArcId a) {
  double r = component.graph.costs[a];
  for (int k = num_kept; k < component.graph.num_dimensions(); ++k)
    r -= u[component.graph.slot(k, a)];
  return r;
}

/// phi(w; u) of (3.2): the arcs, what kept indices lack, and relaxed indices at their best number
/// of uses.
inline double relaxed_cost(const BoundedComponent& component,
                           int num_kept,
                           std::span<const double> u,
                           std::span<const core::ArcId> arcs) {
  const std::vector<Index> uses = count_uses(component.graph, arcs);
  double cost = 0;
  for (const core::ArcId a : arcs) cost += reduced(component, num_kept, u, a);
  for (std::size_t k = 0; k < component.graph.sizes.size(); ++k) {
    const std::uint32_t dummy = component.graph.offset[k];
    for (std::uint32_t slot = dummy + 1; slot <= dummy + component.graph.sizes[k]; ++slot) {
      const Row& row = component.rows[slot];
      double least = row.cost(uses[slot]);
      if (k >= static_cast<std::size_t>(num_kept)) {
        for (Index n = 0; n <= row.hi; ++n)
          least = n == 0 ? row.cost(0) : std::min(least, row.cost(n) + u[slot] * n);
      }
      cost += least;
    }
  }
  return cost;
}

/// Calls visit(arcs) for every set of arcs that uses no index of the first num_kept dimensions more
/// often than it may be: the feasible solutions of (3.2), singletons left out.
class RelaxedChoices {
 public:
  using Visit = std::function<void(const std::vector<core::ArcId>&)>;

  RelaxedChoices(const BoundedComponent& component, int num_kept, const Visit& visit)
      : component_(component), num_kept_(num_kept), visit_(visit), used_(component.rows.size(), 0) {
    extend(0);
  }

 private:
  void extend(core::ArcId next) {
    if (next == component_.num_arcs()) return visit_(arcs_);
    extend(next + 1);
    bool fits = true;
    for_each_kept(next, [&](std::uint32_t s) { fits = fits && used_[s] < component_.rows[s].hi; });
    if (!fits) return;
    for_each_kept(next, [&](std::uint32_t s) { ++used_[s]; });
    arcs_.push_back(next);
    extend(next + 1);
    arcs_.pop_back();
    for_each_kept(next, [&](std::uint32_t s) { --used_[s]; });
  }

  template <typename Use>
  void for_each_kept(core::ArcId a, Use&& use) {
    for (int k = 0; k < num_kept_; ++k) {
      if (component_.graph.index(k, a) != 0) use(component_.graph.slot(k, a));
    }
  }

  const BoundedComponent& component_;
  const int num_kept_;
  const Visit& visit_;
  std::vector<Index> used_;
  std::vector<core::ArcId> arcs_;
};

inline double least_relaxed_cost(const BoundedComponent& component,
                                 int num_kept,
                                 std::span<const double> u) {
  double least = kInfinity;
  RelaxedChoices(component, num_kept, [&](const std::vector<core::ArcId>& arcs) {
    least = std::min(least, relaxed_cost(component, num_kept, u, arcs));
  });
  return least;
}

/// The best choice of all, by listing them; nothing relaxed.
inline Choice best_choice(const BoundedComponent& component) {
  Choice best{{}, kInfinity};
  const int all = component.graph.num_dimensions();
  RelaxedChoices(component, all, [&](const std::vector<core::ArcId>& arcs) {
    const double cost = relaxed_cost(component, all, {}, arcs);
    if (cost < best.cost) best = {arcs, cost};
  });
  return best;
}

}  // namespace nda::bounded
