#include "support/components.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "support/brute_force.hpp"

namespace nda::support {

using core::ArcId;
using core::Component;
using core::Packing;
using core::Random;

Component whole_component(const Problem& problem) {
  Component component = core::make_component({problem.sizes().begin(), problem.sizes().end()});
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    const std::vector<Index> tuple = problem.arc(a);
    double cost = problem.costs()[a];
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      cost -= problem.singleton_costs(static_cast<int>(k))[tuple[k]];
    }
    core::append_arc(component, tuple, cost);
  }
  return component;
}

Problem to_problem(const Component& component) {
  ProblemBuilder builder(component.sizes);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    std::vector<Index> tuple;
    for (int k = 0; k < component.num_dimensions(); ++k) tuple.push_back(component.index(k, a));
    builder.add_arc(tuple, component.costs[a]);
  }
  return std::move(builder).build();
}

Component random_component(std::uint64_t seed, const RandomComponentOptions& options) {
  Random random(seed);
  ProblemBuilder builder(options.sizes);
  for (int a = 0; a < options.num_arcs; ++a) {
    std::vector<Index> tuple(options.sizes.size(), 0);
    std::size_t real = 0;
    while (real < 2) {
      real = 0;
      for (std::size_t k = 0; k < tuple.size(); ++k) {
        const bool dummy = random.uniform() < options.dummy_share;
        tuple[k] = dummy ? 0 : 1 + static_cast<Index>(random.below(options.sizes[k]));
        real += tuple[k] != 0;
      }
    }
    const bool positive = random.uniform() < options.positive_share;
    const double size = random.uniform(0, positive ? 5 : 20);
    const double cost = options.integer ? std::floor(size) : size;
    builder.add_arc(tuple, positive ? cost : -cost);
  }
  return whole_component(std::move(builder).build());
}

Component random_component_of_any_kind(std::uint64_t seed) {
  Random random(seed ^ 0x636f6d70ULL);
  RandomComponentOptions options;
  options.sizes.resize(2 + random.below(5));
  for (Index& size : options.sizes) size = 1 + static_cast<Index>(random.below(5));
  options.num_arcs = 1 + static_cast<int>(random.below(24));
  options.dummy_share = 0.25 * static_cast<double>(random.below(3));
  options.positive_share = 0.1 * static_cast<double>(random.below(4));
  options.integer = random.below(2) == 0;
  return random_component(seed, options);
}

Component large_component(std::uint64_t seed) {
  RandomComponentOptions options;
  options.sizes = {9, 9, 9};
  options.num_arcs = 150;
  return random_component(seed, options);
}

std::string packing_fault(const Component& component, const Packing& packing, double tolerance) {
  std::set<ArcId> arcs;
  std::set<std::uint32_t> slots;
  double cost = 0;
  for (const ArcId a : packing.arcs) {
    if (a >= component.num_arcs()) return "arc " + std::to_string(a) + " does not exist";
    if (!arcs.insert(a).second) return "arc " + std::to_string(a) + " is in twice";
    for (int k = 0; k < component.num_dimensions(); ++k) {
      if (component.index(k, a) == 0) continue;
      if (!slots.insert(component.slot(k, a)).second) {
        return "index " + std::to_string(component.index(k, a)) + " of dimension " +
               std::to_string(k + 1) + " is used twice";
      }
    }
    cost += component.costs[a];
  }
  if (std::abs(cost - packing.cost) <= tolerance) return "";
  return "states cost " + std::to_string(packing.cost) + ", its arcs cost " + std::to_string(cost);
}

double best_cost(const Component& component) {
  return component.num_arcs() == 0 ? 0 : brute_force(to_problem(component))->cost;
}

namespace {

void extend(const Component& component,
            ArcId next,
            std::vector<bool>& covered,
            Packing& current,
            std::vector<Packing>& all) {
  if (next == component.num_arcs()) return all.push_back(current);
  extend(component, next + 1, covered, current, all);
  std::vector<std::uint32_t> slots;
  for (int k = 0; k < component.num_dimensions(); ++k) {
    if (component.index(k, next) != 0) slots.push_back(component.slot(k, next));
  }
  if (std::any_of(slots.begin(), slots.end(), [&](std::uint32_t s) { return covered[s]; })) return;
  for (const std::uint32_t s : slots) covered[s] = true;
  current.arcs.push_back(next);
  const double before = current.cost;
  current.cost += component.costs[next];
  extend(component, next + 1, covered, current, all);
  current.cost = before;
  current.arcs.pop_back();
  for (const std::uint32_t s : slots) covered[s] = false;
}

}  // namespace

std::vector<Packing> all_packings(const Component& component) {
  std::vector<bool> covered(component.num_slots(), false);
  std::vector<Packing> all;
  Packing current;
  extend(component, 0, covered, current, all);
  return all;
}

std::vector<double> feasible_multipliers(const Component& component, Random& random, double slack) {
  std::vector<double> u(component.num_slots(), 0.0);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    double r = component.costs[a];
    std::vector<std::uint32_t> slots;
    for (int k = 0; k < component.num_dimensions(); ++k) {
      if (component.index(k, a) == 0) continue;
      slots.push_back(component.slot(k, a));
      r -= u[slots.back()];
    }
    if (r >= 0) continue;
    std::vector<double> share(slots.size());
    for (double& part : share) part = random.uniform();
    const double total = sum_of(share);
    for (std::size_t s = 0; s < slots.size(); ++s) u[slots[s]] += r * share[s] / total;
  }
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    for (Index i = 1; i <= component.sizes[k]; ++i) {
      if (random.below(2) == 0) u[component.offset[k] + i] -= slack * random.uniform();
    }
  }
  return u;
}

double sum_of(std::span<const double> u) {
  return std::accumulate(u.begin(), u.end(), 0.0);
}

std::string multiplier_fault(const Component& component,
                             std::span<const double> u,
                             double tolerance) {
  if (u.size() != component.num_slots()) return std::to_string(u.size()) + " multipliers";
  for (std::size_t s = 0; s < u.size(); ++s) {
    if (!(u[s] <= 0)) return "multiplier of slot " + std::to_string(s) + " is positive";
  }
  for (const std::uint32_t dummy : component.offset) {
    if (u[dummy] != 0) return "multiplier of dummy " + std::to_string(dummy) + " is not 0";
  }
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    double r = component.costs[a];
    for (int k = 0; k < component.num_dimensions(); ++k) r -= u[component.slot(k, a)];
    if (!(r >= -tolerance)) {
      return "reduced cost of arc " + std::to_string(a) + " is " + std::to_string(r);
    }
  }
  return "";
}

}  // namespace nda::support
