#pragma once

#include "nda/generate.hpp"
#include "nda/problem.hpp"

namespace nda {

/// One component of 25 x 25 x 25 x 25 with random costs: nobody proves its optimum in seconds.
inline const Problem& hard_problem() {
  static const Problem problem = [] {
    PooreSparseOptions options;
    options.arcs = 4000;
    return generate_poore_sparse(options).problem;
  }();
  return problem;
}

/// The same of 10 x 10 x 10 x 10: quickly relaxed, slowly proven.
inline const Problem& small_hard_problem() {
  static const Problem problem = [] {
    PooreSparseOptions options;
    options.min_size = options.max_size = 10;
    options.arcs = 600;
    return generate_poore_sparse(options).problem;
  }();
  return problem;
}

/// Many components of a few dozen arcs each, with an integrality gap; the optimum is known.
inline const Instance& gadgets() {
  static const Instance instance = [] {
    GadgetsOptions options;
    options.gadgets = 60;
    options.size = 3;
    options.arcs_per_gadget = 14;
    return generate_gadgets(options);
  }();
  return instance;
}

/// Some thousand arcs in components of all sizes, no integrality gap; the optimum is known.
inline const Instance& planted(PlantedSingletons singletons) {
  const auto make = [](PlantedSingletons kind) {
    PlantedOptions options;
    options.size = 150;
    options.arcs = 1200;
    options.spread = 4;
    options.miss_rate = kind == PlantedSingletons::kForbidden ? 0 : 0.1;
    options.singletons = kind;
    return generate_planted(options);
  };
  static const Instance instances[] = {make(PlantedSingletons::kFree),
                                       make(PlantedSingletons::kPriced),
                                       make(PlantedSingletons::kForbidden)};
  return instances[static_cast<int>(singletons)];
}

}  // namespace nda
