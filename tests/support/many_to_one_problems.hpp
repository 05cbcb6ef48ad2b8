#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "nda/problem.hpp"

/// Problems with bounds, and what can be said of them without any solver.
namespace nda::support {

/// Two targets, each missed at 4, and one detection, a false alarm at 1, which both may share
/// (1..2).  Taking (1,1) and (2,1) costs 2 + 3 = 5; one target alone 2 + 4 or 3 + 4; none 4 + 4
/// + 1. u = 2 3 | 0 proves 5: 2 + 3 + min(0, 1) * lo + min(0, 0) + min(0, 0).
inline Problem shared_detection() {
  ProblemBuilder builder({2, 1});
  builder.add_arc({1, 0}, 4);
  builder.add_arc({2, 0}, 4);
  builder.add_arc({0, 1}, 1);
  builder.add_arc({1, 1}, 2);
  builder.add_arc({2, 1}, 3);
  builder.set_use_bounds(1, 1, {1, 2});
  return std::move(builder).build();
}

struct BoundedKind {
  int dimensions = 3;
  int num_arcs = 10;
  bool integer = true;      ///< costs are small integers, full of ties
  bool forbidding = false;  ///< some singletons are forbidden
  Index largest = 3;        ///< most indices of a dimension
  bool tight = false;       ///< bounds of 0..1, 1..1 and 1..2 alone, and arcs that pay
  double size = 1;          ///< all costs are multiplied by it
};

inline UseBounds random_bounds(core::Random& random, bool tight) {
  if (tight) return {random.below(4) == 0 ? 0u : 1u, random.below(4) == 0 ? 2u : 1u};
  switch (random.below(7)) {
    case 0:
      return {0, 0};
    case 1:
      return {0, UseBounds::kUnlimited};
    case 2:
      return {2, 2};
    case 3:
      return {1, 3};
    case 4:
      return {0, 2};
    case 5:
      return {static_cast<Index>(random.below(5)), 7};
    default:
      return {};
  }
}

inline double random_cost(core::Random& random, bool integer, double low, double high) {
  const double cost = low + (high - low) * random.uniform();
  return integer ? std::round(cost) : cost;
}

inline Problem random_bounded_problem(std::uint64_t seed, const BoundedKind& kind) {
  core::Random random(seed);
  std::vector<Index> sizes;
  for (int k = 0; k < kind.dimensions; ++k)
    sizes.push_back(1 + static_cast<Index>(random.below(kind.largest)));
  ProblemBuilder builder(sizes);
  std::vector<Index> tuple(sizes.size());
  for (int k = 0; k < kind.dimensions; ++k) {
    for (Index i = 1; i <= sizes[static_cast<std::size_t>(k)]; ++i) {
      std::fill(tuple.begin(), tuple.end(), 0u);
      tuple[static_cast<std::size_t>(k)] = i;
      UseBounds bounds = random_bounds(random, kind.tight);
      double single = random_cost(random, kind.integer, -3, 6);
      if (bounds.hi == UseBounds::kUnlimited) single = std::abs(single);
      if (kind.forbidding && random.below(3) == 0) single = kInfinity;
      builder.add_arc(tuple, single * kind.size);
      builder.set_use_bounds(k, i, bounds);
    }
  }
  for (int n = 0; n < kind.num_arcs; ++n) {
    int real = 0;
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      tuple[k] = static_cast<Index>(random.below(sizes[k] + 1));
      real += tuple[k] != 0;
    }
    const double dearest = kind.tight ? 0 : 12;
    if (real < 2) continue;
    builder.add_arc(tuple, random_cost(random, kind.integer, -8, dearest) * kind.size);
  }
  return std::move(builder).build();
}

/// What so many uses of an index cost in singletons; nothing where that is impossible.
inline std::optional<long double> singletons_of(UseBounds bounds, double single, Index uses) {
  if (uses > bounds.hi) return std::nullopt;
  const Index times = single < 0 ? bounds.hi - uses : uses < bounds.lo ? bounds.lo - uses : 0;
  if (times == 0) return 0.0L;
  if (single == kInfinity) return std::nullopt;
  return static_cast<long double>(single) * times;
}

/// The cost of choosing these arcs; nothing where that is no solution.
inline std::optional<long double> cost_of_choice(const Problem& problem,
                                                 const std::vector<std::size_t>& arcs) {
  long double cost = 0;
  for (const std::size_t a : arcs) cost += problem.costs()[a];
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      Index uses = 0;
      for (const std::size_t a : arcs) uses += problem.indices(k)[a] == i;
      const auto more =
          singletons_of(problem.use_bounds(k, i), problem.singleton_costs(k)[i], uses);
      if (!more) return std::nullopt;
      cost += *more;
    }
  }
  return cost;
}

/// The least cost over all subsets of the arcs; nothing where there is no solution.
inline std::optional<double> best_of_all(const Problem& problem) {
  std::optional<long double> best;
  std::vector<std::size_t> arcs;
  for (std::uint64_t subset = 0; subset < std::uint64_t{1} << problem.num_arcs(); ++subset) {
    arcs.clear();
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      if ((subset >> a & 1) != 0) arcs.push_back(a);
    }
    const auto cost = cost_of_choice(problem, arcs);
    if (cost && (!best || *cost < *best)) best = cost;
  }
  if (!best) return std::nullopt;
  return static_cast<double>(*best);
}

/// What multipliers prove: the formula of Theorem 4.1 with bounds, every n tried.
inline double bound_of(const Problem& problem, const std::vector<std::vector<double>>& u) {
  long double bound = 0;
  std::vector<long double> r(problem.costs().begin(), problem.costs().end());
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    std::vector<Index> degree(problem.size(k) + std::size_t{1}, 0);
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      const Index i = problem.indices(k)[a];
      ++degree[i];
      if (i != 0) r[a] -= u[static_cast<std::size_t>(k)][i - 1];
    }
    for (Index i = 1; i <= problem.size(k); ++i) {
      const UseBounds bounds = problem.use_bounds(k, i);
      long double least = kInfinity;
      for (Index n = 0; n <= std::min(bounds.hi, degree[i]); ++n) {
        const auto cost = singletons_of(bounds, problem.singleton_costs(k)[i], n);
        if (cost)
          least = std::min(
              least, *cost + n * static_cast<long double>(u[static_cast<std::size_t>(k)][i - 1]));
      }
      bound += least;
    }
  }
  for (const long double reduced : r) bound += std::min(0.0L, reduced);
  return static_cast<double>(bound);
}

}  // namespace nda::support
