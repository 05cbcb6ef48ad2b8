#include "support/random_problems.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/random.hpp"

namespace nda::support {
namespace {

using core::Random;

const char* const kSingletonNames[] = {"free", "priced", "forbidden", "mixed"};
const char* const kCostNames[] = {"integer", "few", "zero", "decimal", "huge", "tiny", "wild"};
const char* const kSignNames[] = {"negative", "positive", "mixed-sign"};

double magnitude(Random& random, CostKind kind) {
  switch (kind) {
    case CostKind::kInteger:
      return static_cast<double>(random.below(101));
    case CostKind::kFew:
      return static_cast<double>(random.below(4));
    case CostKind::kZero:
      return 0;
    case CostKind::kDecimal:
      return random.uniform(0, 10);
    case CostKind::kHuge:
      return std::floor(random.uniform(1e9, 1e12));
    case CostKind::kTiny:
      return random.uniform(0, 1e-12);
    case CostKind::kWild:
      return magnitude(random, static_cast<CostKind>(random.below(6)));
  }
  return 0;
}

double draw_cost(Random& random, const RandomProblemOptions& options) {
  const double value = magnitude(random, options.costs);
  const bool negative = options.sign == SignKind::kNegative ||
                        (options.sign == SignKind::kMixed && random.below(2) == 0);
  return negative ? -value : value;
}

std::vector<Index> draw_tuple(Random& random, const RandomProblemOptions& options) {
  std::vector<Index> tuple(options.sizes.size(), 0);
  const auto real = [](Index i) { return i != 0; };
  while (std::count_if(tuple.begin(), tuple.end(), real) < 2) {
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      const bool dummy = random.uniform() < options.dummy_share;
      tuple[k] = dummy ? 0 : 1 + static_cast<Index>(random.below(options.sizes[k]));
    }
  }
  return tuple;
}

double draw_singleton(Random& random, const RandomProblemOptions& options) {
  SingletonKind kind = options.singletons;
  if (kind == SingletonKind::kMixed) kind = static_cast<SingletonKind>(random.below(3));
  if (kind == SingletonKind::kForbidden) return kInfinity;
  return kind == SingletonKind::kFree ? 0 : draw_cost(random, options);
}

// Singletons that pay are limited.
UseBounds draw_bounds(Random& random, double singleton) {
  const Index lo = static_cast<Index>(random.below(3));
  const bool unlimited = random.below(4) == 0 && singleton >= 0;
  return {lo, unlimited ? UseBounds::kUnlimited : lo + static_cast<Index>(random.below(3))};
}

// Row r of the planted solution takes index permutation[k][r] of each dimension, or the dummy
// beyond M_k. What is alone in its row gets a finite singleton.
void plant(Random& random, const RandomProblemOptions& options, ProblemBuilder& builder) {
  const Index rows = *std::max_element(options.sizes.begin(), options.sizes.end());
  std::vector<std::vector<Index>> tuples(rows, std::vector<Index>(options.sizes.size(), 0));
  for (std::size_t k = 0; k < options.sizes.size(); ++k) {
    std::vector<Index> permutation(rows, 0);
    for (Index i = 0; i < options.sizes[k]; ++i) permutation[i] = i + 1;
    core::shuffle(permutation, random);
    for (Index r = 0; r < rows; ++r) tuples[r][k] = permutation[r];
  }
  for (const std::vector<Index>& tuple : tuples) {
    const auto real = std::count_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; });
    if (real > 0) builder.add_arc(tuple, draw_cost(random, options));
  }
}

}  // namespace

Problem random_problem(std::uint64_t seed, const RandomProblemOptions& options) {
  Random random(seed);
  ProblemBuilder builder(options.sizes);
  for (std::size_t k = 0; k < options.sizes.size(); ++k) {
    for (Index i = 1; i <= options.sizes[k]; ++i) {
      std::vector<Index> tuple(options.sizes.size(), 0);
      tuple[k] = i;
      const double singleton = draw_singleton(random, options);
      builder.add_arc(tuple, singleton);
      if (options.bounds_share > 0 && random.uniform() < options.bounds_share)
        builder.set_use_bounds(static_cast<int>(k), i, draw_bounds(random, singleton));
    }
  }
  if (options.plant) plant(random, options, builder);
  for (int a = 0; a < options.num_arcs; ++a) {
    const std::vector<Index> tuple = draw_tuple(random, options);
    builder.add_arc(tuple, draw_cost(random, options));
  }
  return std::move(builder).build();
}

namespace {

RandomCase draw_case(std::uint64_t seed, const RandomProblemOptions& options) {
  Problem problem = random_problem(seed, options);
  std::ostringstream text;
  text << "seed " << seed << ": sizes";
  for (const Index size : options.sizes) text << ' ' << size;
  text << ", " << problem.num_arcs() << " arcs, " << kSignNames[static_cast<int>(options.sign)]
       << ' ' << kCostNames[static_cast<int>(options.costs)] << " costs, singletons "
       << kSingletonNames[static_cast<int>(options.singletons)]
       << (options.plant ? ", planted" : "") << (problem.is_many_to_one() ? ", bounds" : "");
  return {options, std::move(problem), text.str()};
}

}  // namespace

RandomCase random_case(std::uint64_t seed) {
  Random random(seed ^ 0x6e6461ULL);
  RandomProblemOptions options;
  options.sizes.resize(2 + random.below(5));
  for (Index& size : options.sizes) size = 1 + static_cast<Index>(random.below(5));
  options.num_arcs = static_cast<int>(random.below(26));
  options.dummy_share = 0.25 * static_cast<double>(random.below(4));
  options.singletons = static_cast<SingletonKind>(random.below(4));
  options.costs = static_cast<CostKind>(random.below(7));
  options.sign = static_cast<SignKind>(random.below(3));
  options.plant = random.below(2) == 0;
  return draw_case(seed, options);
}

RandomCase random_bounded_case(std::uint64_t seed) {
  Random random(seed ^ 0x626f756e64ULL);
  RandomProblemOptions options;
  options.sizes.resize(2 + random.below(3));
  for (Index& size : options.sizes) size = 1 + static_cast<Index>(random.below(3));
  options.num_arcs = static_cast<int>(random.below(15));
  options.dummy_share = 0.25 * static_cast<double>(random.below(3));
  options.singletons = static_cast<SingletonKind>(random.below(4));
  options.costs = static_cast<CostKind>(random.below(4));
  options.sign = static_cast<SignKind>(random.below(3));
  options.bounds_share = 0.5;
  return draw_case(seed, options);
}

}  // namespace nda::support
