#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nda/baselines.hpp"
#include "nda/generate.hpp"
#include "support/brute_force.hpp"

namespace nda {
namespace {

PlantedOptions tiny(PlantedSingletons singletons, std::uint64_t seed) {
  PlantedOptions options;
  options.dimensions = 2 + static_cast<int>(seed % 4);
  options.size = 2 + static_cast<Index>(seed % 3);
  options.arcs = 20;
  options.miss_rate = singletons == PlantedSingletons::kForbidden ? 0 : 0.3;
  options.spread = seed % 2 == 0 ? 0 : 3;
  options.max_slack = seed % 5 == 0 ? 0 : 5;
  options.singletons = singletons;
  options.seed = seed;
  return options;
}

TEST(Planted, HasTheOptimumItStates) {
  for (const auto singletons :
       {PlantedSingletons::kFree, PlantedSingletons::kPriced, PlantedSingletons::kForbidden}) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      SCOPED_TRACE(seed);
      const Instance instance = generate_planted(tiny(singletons, seed));
      const auto best = support::brute_force(instance.problem);
      ASSERT_TRUE(best);
      EXPECT_NEAR(best->cost, *instance.optimum, 1e-9);
    }
  }
}

TEST(Planted, WritesTheOptimumAsAComment) {
  const Instance instance = generate_planted();
  EXPECT_THAT(instance.comments[0], ::testing::HasSubstr("nda generate planted --seed 1 "));
  EXPECT_NEAR(std::stod(instance.comments[1].substr(8)), *instance.optimum, 1e-6);
}

TEST(Planted, IsNotSolvedByGreedy) {
  const Instance instance = generate_planted();
  EXPECT_GT(solve_greedy(instance.problem).cost, 0.99 * *instance.optimum);
}

TEST(Planted, HasAboutTheRequestedArcs) {
  const Problem problem = generate_planted().problem;
  EXPECT_GT(problem.num_arcs(), 20000u);
  EXPECT_LE(problem.num_arcs(), 20000u + 1111u);
}

TEST(Planted, RejectsOptionsOutOfRange) {
  PlantedOptions options;
  options.singletons = PlantedSingletons::kForbidden;
  EXPECT_THROW(generate_planted(options), InputError);
  options = {};
  options.miss_rate = 0.95;
  EXPECT_THROW(generate_planted(options), InputError);
  options = {};
  options.max_multiplier = 0;
  EXPECT_THROW(generate_planted(options), InputError);
}

}  // namespace
}  // namespace nda
