#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nda/baselines.hpp"
#include "nda/generate.hpp"

// The families with bounds on uses.

namespace nda {
namespace {

TEST(Bounded, HasASolutionAndBoundsOfEveryKind) {
  BoundedOptions options;
  options.size = 4;
  options.arcs = 14;
  int num_bounded = 0, num_unlimited = 0, num_covers = 0;
  for (options.seed = 1; options.seed <= 100; ++options.seed) {
    SCOPED_TRACE(options.seed);
    const Problem problem = generate_bounded(options).problem;
    EXPECT_TRUE(solve_brute_force(problem).feasible);
    for (int k = 0; k < 3; ++k) {
      for (Index i = 1; i <= 4; ++i) {
        const auto [lo, hi] = problem.use_bounds(k, i);
        const bool unlimited = hi == UseBounds::kUnlimited;
        EXPECT_LE(lo, 3u);
        EXPECT_TRUE(unlimited || (hi >= 1 && hi <= 3));
        num_bounded += problem.use_bounds(k, i) != UseBounds{};
        num_unlimited += unlimited;
        num_covers += lo > 1;
        const double singleton = problem.singleton_costs(k)[i];
        EXPECT_TRUE(singleton >= 0 && singleton <= 100 && singleton == std::floor(singleton));
      }
    }
  }
  EXPECT_NEAR(num_bounded, 1200 * 0.5 * 0.89, 60);  // one draw in nine or so is 1..1
  EXPECT_GT(num_unlimited, 100);
  EXPECT_GT(num_covers, 200);
}

TEST(Merged, HasTheTargetsInFrontAndSecondUsesAtAPenalty) {
  const Problem problem = generate_merged().problem;
  ASSERT_EQ(problem.num_dimensions(), 3);
  EXPECT_EQ(problem.size(0), 12u);
  const double missed = 3 - 2 * std::log(0.1);
  for (int k = 0; k < 3; ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      EXPECT_EQ(problem.use_bounds(k, i), (UseBounds{1, 2}));
      EXPECT_NEAR(problem.singleton_costs(k)[i], k == 0 ? missed : 2, 2e-6);
    }
  }
  for (const Index target : problem.indices(0)) EXPECT_NE(target, 0u);
}

// The cost of a tuple is that of its target and its detections, so with one scan missed
// c(t, d, e) - c(t, d, 0) = c(t, 0, e) - c(t, 0, 0).
TEST(Merged, AddsUpOverTheScans) {
  const Problem problem = generate_merged().problem;
  int num_full = 0;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    const std::vector<Index> tuple = problem.arc(a);
    if (tuple[1] == 0 || tuple[2] == 0) continue;
    const auto first = problem.find(std::vector<Index>{tuple[0], tuple[1], 0});
    const auto second = problem.find(std::vector<Index>{tuple[0], 0, tuple[2]});
    ASSERT_TRUE(first && second);
    const double alone = problem.singleton_costs(0)[tuple[0]];
    EXPECT_NEAR(
        problem.costs()[a] + alone, problem.costs()[*first] + problem.costs()[*second], 1e-9);
    ++num_full;
  }
  EXPECT_GT(num_full, 20);
}

// Penalties of p and q add p for every detection and q for every target to whatever uses each once.
TEST(Merged, ChargesAConstantForThePenalties) {
  int num_small = 0;
  MergedOptions options;
  options.targets = 3;
  options.side = 60;
  options.clutter = 1;
  options.scans = 1;
  for (options.seed = 1; options.seed <= 30; ++options.seed) {
    SCOPED_TRACE(options.seed);
    options.merge_penalty = options.split_penalty = 1000;
    const Instance dear = generate_merged(options);
    options.merge_penalty = options.split_penalty = 0;
    const Instance cheap = generate_merged(options);
    ASSERT_EQ(dear.problem.num_arcs(), cheap.problem.num_arcs());
    if (cheap.problem.num_arcs() > 16) continue;
    ++num_small;
    const double constant = 1000.0 * static_cast<double>(dear.problem.num_indices());
    EXPECT_EQ(dear.comments[1],
              "the penalties add " + std::to_string(static_cast<int>(constant)) +
                  " to the cost of every solution");
    // A second use is never worth 1000, and for nothing it is at least as good as one.
    const double once = solve_brute_force(dear.problem).cost - constant;
    EXPECT_LE(solve_brute_force(cheap.problem).cost, once + 1e-6);
  }
  EXPECT_GT(num_small, 20);
}

TEST(Merged, RejectsMoreHypothesesThanFitAnywhere) {
  MergedOptions options;
  options.scans = 8;
  options.targets = 100;
  options.side = 1;
  EXPECT_THROW(generate_merged(options), InputError);
}

}  // namespace
}  // namespace nda
