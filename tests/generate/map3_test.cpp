#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nda/generate.hpp"
#include "support/brute_force.hpp"

namespace nda {
namespace {

TEST(Map3, IsDenseWithIntegerCostsAndNoSingletons) {
  const Problem problem = generate_map3().problem;
  EXPECT_EQ(problem.num_arcs(), 1000u);
  for (const double cost : problem.costs()) {
    EXPECT_EQ(cost, std::floor(cost));
    EXPECT_GE(cost, 0);
    EXPECT_LE(cost, 100);
  }
  EXPECT_EQ(*std::min_element(problem.costs().begin(), problem.costs().end()), 0);
  EXPECT_EQ(*std::max_element(problem.costs().begin(), problem.costs().end()), 100);
  for (Index i = 1; i <= 10; ++i) EXPECT_EQ(problem.singleton_costs(1)[i], kInfinity);
}

// All pairs of permutations of a cube.
double best_over_permutations(const Problem& problem) {
  const Index n = problem.size(0);
  std::vector<Index> second(n), third(n);
  std::iota(second.begin(), second.end(), 1u);
  double best = kInfinity;
  do {
    std::iota(third.begin(), third.end(), 1u);
    do {
      double cost = 0;
      for (Index i = 0; i < n; ++i) {
        const std::size_t a = (i * n + second[i] - 1) * n + third[i] - 1;
        cost += problem.costs()[a];
      }
      best = std::min(best, cost);
    } while (std::next_permutation(third.begin(), third.end()));
  } while (std::next_permutation(second.begin(), second.end()));
  return best;
}

TEST(Map3, HasItsOptimumAmongThePairsOfPermutations) {
  Map3Options options;
  options.size = 4;
  for (options.seed = 1; options.seed <= 20; ++options.seed) {
    SCOPED_TRACE(options.seed);
    const Problem problem = generate_map3(options).problem;
    EXPECT_EQ(support::brute_force(problem)->cost, best_over_permutations(problem));
  }
}

TEST(Map3, RejectsOptionsOutOfRange) {
  EXPECT_THROW(generate_map3({3, 0, 0, 100, 1}), InputError);
  EXPECT_THROW(generate_map3({3, 4, 5, 4, 1}), InputError);
  EXPECT_THROW(generate_map3({4, 300, 0, 1, 1}), InputError);
}

}  // namespace
}  // namespace nda
