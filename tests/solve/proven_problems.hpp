#pragma once

#include "nda/options.hpp"
#include "support/random_problems.hpp"

// Problems whose proofs tests of proofs look at.

namespace nda {

// Cuts and branching from the first arc on, the root's bound being poor.
inline Options branching() {
  Options options;
  options.proof = true;
  options.branch.exact_arcs = 0;
  options.relaxation.max_evaluations = 5;
  options.search.local_search = false;
  return options;
}

inline Options plain() {
  Options options;
  options.proof = true;
  return options;
}

// Gaps and components; small enough to be solved in milliseconds.
inline Problem gapped_problem(std::uint64_t seed) {
  support::RandomProblemOptions shape;
  shape.sizes.assign(3 + seed % 4, 8);
  shape.num_arcs = 60 + static_cast<int>(seed % 7) * 20;
  shape.costs = seed % 3 == 0 ? support::CostKind::kInteger : support::CostKind::kDecimal;
  shape.singletons =
      seed % 2 == 0 ? support::SingletonKind::kPriced : support::SingletonKind::kFree;
  return support::random_problem(seed, shape);
}

// Many indices an arc, few arcs: linear programs are far off, cliques are not.
inline Problem dense_problem(std::uint64_t seed) {
  support::RandomProblemOptions shape;
  shape.sizes.assign(20, 20);
  shape.num_arcs = 200;
  shape.dummy_share = 0.7;
  shape.costs = seed % 2 == 0 ? support::CostKind::kInteger : support::CostKind::kDecimal;
  shape.singletons = support::SingletonKind::kFree;
  return support::random_problem(seed, shape);
}

}  // namespace nda
