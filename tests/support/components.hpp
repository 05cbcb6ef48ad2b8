#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/component.hpp"
#include "core/random.hpp"
#include "nda/problem.hpp"

namespace nda::support {

/// All arcs of a problem, shifted, as one component that was cut out of nothing: slots stand for
/// themselves, arc a is arc a of the problem.  Forbidden singletons are not allowed.
core::Component whole_component(const Problem& problem);

/// The component as a problem of its own: singletons 0, arc a is arc a of the component.
Problem to_problem(const core::Component& component);

struct RandomComponentOptions {
  std::vector<Index> sizes = {3, 3, 3};
  int num_arcs = 12;            ///< draws; repeated tuples make it fewer
  double dummy_share = 0.3;     ///< probability that an index of an arc is the dummy
  double positive_share = 0.1;  ///< of the costs; the others are negative
  bool integer = false;         ///< costs -20..5 or so, full of ties; else uniform
};

/// Same seed and options, same component.
core::Component random_component(std::uint64_t seed, const RandomComponentOptions& options = {});

/// Sizes, arcs and costs at random too: N = 2..6, sizes 1..5, up to 24 arcs.
core::Component random_component_of_any_kind(std::uint64_t seed);

/// Three dimensions of nine indices, 150 arcs: too many packings to list.
core::Component large_component(std::uint64_t seed);

/// What is wrong with this packing, one sentence; empty when it is one: no arc twice, no index
/// twice, the cost that of the arcs (to `tolerance`).
std::string packing_fault(const core::Component& component,
                          const core::Packing& packing,
                          double tolerance = 1e-9);

/// Cost of the best packing, by enumeration.
double best_cost(const core::Component& component);

/// Every packing with its cost, the empty one included; arcs ascend.  For about 20 arcs.
std::vector<core::Packing> all_packings(const core::Component& component);

/// Multipliers u <= 0 with all reduced costs >= 0 (to rounding), drawn at random: every arc of
/// negative reduced cost is paid for by its indices in random shares; then u is lowered by up to
/// `slack` here and there.
std::vector<double> feasible_multipliers(const core::Component& component,
                                         core::Random& random,
                                         double slack = 0);

/// Sum of all entries.
double sum_of(std::span<const double> u);

/// What is wrong with multipliers that should prove sum u: empty when all are <= 0, those of the
/// dummies 0, and no reduced cost is below -tolerance.
std::string multiplier_fault(const core::Component& component,
                             std::span<const double> u,
                             double tolerance = 1e-9);

}  // namespace nda::support
