#pragma once

#include <string>
#include <vector>

#include "bounded/split.hpp"
#include "support/many_to_one_problems.hpp"

/// Components with bounds out of random problems.
namespace nda::bounded {

/// Those of at most so many arcs, of the problem with this seed.
inline std::vector<BoundedComponent> random_parts(std::uint64_t seed,
                                                  int dimensions,
                                                  std::size_t most_arcs = 14) {
  support::BoundedKind kind;
  kind.dimensions = dimensions;
  kind.num_arcs = 8 + static_cast<int>(seed % 12);
  kind.tight = seed % 4 != 1;
  kind.integer = seed % 2 == 0;
  kind.forbidding = seed % 3 == 0;
  const Problem problem = support::random_bounded_problem(seed, kind);
  std::vector<BoundedComponent> parts;
  for (BoundedComponent& part : split(problem, {}).parts) {
    if (part.num_arcs() <= most_arcs) parts.push_back(std::move(part));
  }
  return parts;
}

/// The arcs of subset number `bits`, as a choice; cost +inf where it exceeds a bound.
inline Choice choice_of(const BoundedComponent& component, std::uint64_t bits) {
  Choice choice;
  for (core::ArcId a = 0; a < component.num_arcs(); ++a) {
    if ((bits >> a & 1) != 0) choice.arcs.push_back(a);
  }
  const std::vector<Index> uses = count_uses(component.graph, choice.arcs);
  for (const core::ArcId a : choice.arcs) choice.cost += component.graph.costs[a];
  core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
    const Row& row = component.rows[slot];
    choice.cost += uses[slot] > row.hi ? kInfinity : row.cost(uses[slot]);
  });
  return choice;
}

/// Calls visit(choice) for every choice that exceeds no bound.
template <typename Visit>
void for_each_choice(const BoundedComponent& component, Visit&& visit) {
  for (std::uint64_t bits = 0; bits < std::uint64_t{1} << component.num_arcs(); ++bits) {
    const Choice choice = choice_of(component, bits);
    if (choice.cost < kInfinity) visit(choice);
  }
}

inline double least_cost(const BoundedComponent& component) {
  double least = kInfinity;
  for_each_choice(component, [&](const Choice& choice) { least = std::min(least, choice.cost); });
  return least;
}

/// Multipliers by slot, 0 of the dummies; some are 0, some at their singleton.
inline std::vector<double> random_multipliers(const BoundedComponent& component,
                                              core::Random& random) {
  std::vector<double> u(component.rows.size(), 0.0);
  core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
    const std::uint64_t kind = random.below(4);
    if (kind == 0) return;
    u[slot] = kind == 1 ? component.rows[slot].single : random.uniform(-15, 15);
  });
  return u;
}

}  // namespace nda::bounded
