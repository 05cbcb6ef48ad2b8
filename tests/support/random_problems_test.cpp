#include "support/random_problems.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/brute_force.hpp"

namespace nda::support {
namespace {

TEST(RandomCase, CoversEveryKindOfProblem) {
  std::set<int> dimensions, sizes, singletons, costs, signs;
  int feasible = 0, infeasible = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const RandomCase instance = random_case(seed);
    dimensions.insert(instance.problem.num_dimensions());
    for (const Index size : instance.problem.sizes()) sizes.insert(static_cast<int>(size));
    singletons.insert(static_cast<int>(instance.options.singletons));
    costs.insert(static_cast<int>(instance.options.costs));
    signs.insert(static_cast<int>(instance.options.sign));
    EXPECT_LE(instance.problem.num_arcs(), 25u + 5u);
    ++(brute_force(instance.problem) ? feasible : infeasible);
  }
  EXPECT_EQ(dimensions, (std::set<int>{2, 3, 4, 5, 6}));
  EXPECT_EQ(sizes, (std::set<int>{1, 2, 3, 4, 5}));
  EXPECT_EQ(singletons.size(), 4u);
  EXPECT_EQ(costs.size(), 7u);
  EXPECT_EQ(signs.size(), 3u);
  EXPECT_GT(infeasible, 50);
  EXPECT_GT(feasible, 300);
}

TEST(RandomProblem, IsFeasibleWhenPlanted) {
  RandomProblemOptions options;
  options.sizes = {2, 4, 3};
  options.singletons = SingletonKind::kForbidden;
  options.plant = true;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    EXPECT_TRUE(brute_force(random_problem(seed, options)));
  }
}

TEST(RandomProblem, IsTheSameForTheSameSeed) {
  const Problem first = random_problem(7);
  const Problem second = random_problem(7);
  ASSERT_EQ(first.num_arcs(), second.num_arcs());
  for (std::size_t a = 0; a < first.num_arcs(); ++a) {
    EXPECT_EQ(first.arc(a), second.arc(a));
    EXPECT_EQ(first.costs()[a], second.costs()[a]);
  }
}

}  // namespace
}  // namespace nda::support
