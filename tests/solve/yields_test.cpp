#include <gtest/gtest.h>

#include "core/shift.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/many_to_one_problems.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

// What Stats says of components, reductions and fixing.

namespace nda {
namespace {

// Those that can improve on their singletons.
std::size_t num_arcs_after_shift(const Problem& problem) {
  const core::Shift shift = core::make_shift(problem);
  std::size_t count = 0;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a)
    count += core::shifted_cost(problem, shift, a) < 0;
  return count;
}

// The component of (0,2,2) comes before that of (1,1,0), though index 1 is the smaller one.
TEST(Yields, ComponentsComeInTheOrderOfTheirSmallestArc) {
  const support::TinyProblem tiny = support::two_components();
  const Solution solution = solve(tiny.problem);
  ASSERT_EQ(solution.components.size(), 2u);
  EXPECT_EQ(solution.components[0].cost, -3);
  EXPECT_EQ(solution.components[1].cost, -2);
}

// Every bound on what is left is below the one before, whatever the method, hot or not.
TEST(Yields, EveryFixingLeavesAPartOfWhatThereWas) {
  std::size_t dropped = 0, excluded = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    if (random.problem.is_many_to_one()) continue;
    // Penalties of forbidden ones move costs.
    const bool has_free_singletons = core::make_shift(random.problem).penalty == 0;
    Options options;
    options.search.reductions = seed % 2 == 0 ? Reductions::kAll : Reductions::kNone;
    options.branch.exact_arcs = seed % 3 == 0 ? 0 : 200;
    const Solution cold = solve(random.problem, options);
    const Solution hot = solve(random.problem, options, warm_start(cold));
    for (const Stats& stats : {cold.stats, hot.stats}) {
      const ExchangeYield& exchange = stats.exchange;
      if (cold.status == Status::kOptimal && has_free_singletons) {
        const std::size_t arcs = num_arcs_after_shift(random.problem);
        EXPECT_TRUE(stats.arcs_after_shift == arcs ||
                    (exchange.rounds == 0 && stats.arcs_after_shift == random.problem.num_arcs()))
            << stats.arcs_after_shift << " of " << arcs;
      }
      EXPECT_LE(exchange.kept + exchange.excluded, exchange.arcs);
      EXPECT_LE(stats.arcs_after_fixing,
                stats.arcs_after_shift - exchange.kept - exchange.excluded);
      EXPECT_LE(stats.arcs_left, stats.arcs_after_fixing);
      EXPECT_LE(stats.settled_components, stats.tried_components);
      EXPECT_EQ(stats.reductions.components, stats.settled_components);
      EXPECT_LE(stats.forgotten_reductions.components,
                stats.tried_components - stats.settled_components);
      dropped += stats.arcs_after_shift - stats.arcs_left;
      excluded += exchange.excluded;
    }
    EXPECT_EQ(cold.stats.exchange.rounds, 0);
    EXPECT_EQ(hot.stats.exchange.rounds > 0, hot.stats.exchange.arcs > 0);
    if (HasFailure()) return;
  }
  EXPECT_GT(dropped, 1000);
  EXPECT_GT(excluded, 500);
}

// Parts with bounds: some are fixed, and those that end at once count with all of their arcs.
TEST(Yields, OfPartsWithBoundsAreWhatFixingLeft) {
  int whole = 0, fixed = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    support::BoundedKind kind;
    kind.num_arcs = 14;
    kind.tight = true;
    const Solution solution = solve(support::random_bounded_problem(seed, kind));
    const Stats& stats = solution.stats;
    if (solution.status != Status::kOptimal) continue;
    std::size_t arcs = 0;
    for (const ComponentReport& component : solution.components) arcs += component.num_arcs;
    EXPECT_EQ(stats.arcs_after_shift, arcs);
    EXPECT_LE(stats.arcs_after_fixing, arcs);
    EXPECT_LE(stats.arcs_left, stats.arcs_after_fixing);
    whole += stats.arcs_left == arcs && arcs > 0;
    fixed += stats.arcs_left < arcs;
  }
  EXPECT_GT(whole, 50);
  EXPECT_GT(fixed, 5);
}

// Where the search that comes first does not end, Lagrangian branch and bound has the rest of the
// nodes.
TEST(Yields, OfLagrangianBranchAndBoundAreCountedFromTheRootOn) {
  PooreSparseOptions hard;
  hard.min_size = hard.max_size = 14;
  hard.arcs = 500;
  Options options;
  options.method = Method::kExact;
  options.branch.max_nodes = 201000;
  const Stats stats = solve(generate_poore_sparse(hard).problem, options).stats;
  EXPECT_LT(stats.arcs_after_fixing, stats.arcs_after_shift);
  EXPECT_EQ(stats.arcs_left, stats.arcs_after_fixing);
  EXPECT_GE(stats.branching.dropped, stats.arcs_after_shift - stats.arcs_left);
  EXPECT_GT(stats.searches.taken, 0);
  EXPECT_GT(stats.searches.parts, stats.searches.splits);
}

}  // namespace
}  // namespace nda
