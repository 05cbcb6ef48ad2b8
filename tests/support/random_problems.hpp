#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nda/problem.hpp"

namespace nda::support {

enum class SingletonKind {
  kFree,       ///< all 0
  kPriced,     ///< drawn like the arc costs
  kForbidden,  ///< all +inf, save those of a planted solution
  kMixed,      ///< each of the above for a third of the indices
};

/// Magnitude of the costs, before the sign.
enum class CostKind {
  kInteger,  ///< 0..100
  kFew,      ///< 0..3, so that ties abound
  kZero,     ///< all 0
  kDecimal,  ///< uniform in [0, 10)
  kHuge,     ///< uniform in [1e9, 1e12)
  kTiny,     ///< uniform in [0, 1e-12)
  kWild,     ///< any of the above, arc by arc
};

enum class SignKind { kNegative, kPositive, kMixed };

struct RandomProblemOptions {
  std::vector<Index> sizes = {3, 3, 3};
  int num_arcs = 12;         ///< draws; repeated tuples and singletons make it fewer
  double dummy_share = 0.3;  ///< probability that an index of an arc is the dummy
  SingletonKind singletons = SingletonKind::kFree;
  CostKind costs = CostKind::kDecimal;
  SignKind sign = SignKind::kNegative;
  bool plant = false;       ///< make it feasible even when singletons are forbidden
  double bounds_share = 0;  ///< probability that an index has bounds of its own, 0..3 or unlimited
};

/// A random problem; the same seed and options give the same problem.
Problem random_problem(std::uint64_t seed, const RandomProblemOptions& options = {});

struct RandomCase {
  RandomProblemOptions options;
  Problem problem;
  std::string description;  ///< one line, with the seed: for SCOPED_TRACE
};

/// All options drawn at random: N = 2..6, sizes 1..5, 0..25 draws of arcs, every kind of cost and
/// singleton. Of the cases with forbidden singletons about half are feasible.
RandomCase random_case(std::uint64_t seed);

/// The same with bounds on uses: N = 2..4, sizes 1..3, at most 14 draws of arcs, half of all
/// indices with bounds of their own.  Some are infeasible.
RandomCase random_bounded_case(std::uint64_t seed);

}  // namespace nda::support
