#include "solve/settling.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/components.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::ElementsAre;

Solution solve_with(Reductions reductions, const Problem& problem) {
  Options options;
  options.search.reductions = reductions;
  options.proof = true;
  return solve(problem, options);
}

bool is_lost(const Solution& solution) {
  return solution.status == Status::kPrecisionLost;
}

// Solves with each setting; all must agree, and their certificates and proofs must hold.  Returns
// how many components the quick and all reductions settled.
std::array<std::size_t, 2> settled_by(const Problem& problem) {
  const Solution plain = solve_with(Reductions::kNone, problem);
  std::array<std::size_t, 2> settled = {};
  EXPECT_EQ(plain.stats.settled_components, 0);
  for (const Reductions reductions : {Reductions::kQuick, Reductions::kAll}) {
    const Solution solution = solve_with(reductions, problem);
    if (is_lost(solution) || is_lost(plain)) {
      // Whether the certificate meets the cost by itself then decides.
      EXPECT_TRUE(is_lost(solution) || solution.status == Status::kOptimal);
      EXPECT_TRUE(is_lost(plain) || plain.status == Status::kOptimal);
    } else {
      EXPECT_EQ(solution.status, plain.status);
      EXPECT_EQ(solution.proven, plain.proven);
    }
    if (solution.solutions.empty()) continue;
    EXPECT_NEAR(solution.cost, plain.cost, 1e-9 * std::max(1.0, std::abs(plain.cost)));
    const CheckReport report = check(problem, solution, *solution.proof);
    EXPECT_TRUE(report.passed()) << report.faults.front();
    settled[reductions == Reductions::kAll] += solution.stats.settled_components;
  }
  return settled;
}

TEST(Settling, ChangesNoOptimumAndLeavesAProof) {
  std::size_t settled = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    SCOPED_TRACE(test.description);
    settled += settled_by(test.problem)[0];
    if (HasFailure()) return;
  }
  EXPECT_GT(settled, 300);
}

TEST(Settling, ChangesNoOptimumOfProblemsOfManyComponents) {
  settled_by(gadgets().problem);
  settled_by(planted(PlantedSingletons::kPriced).problem);
  TrackingOptions tracking;
  tracking.scans = 5;
  tracking.targets = 150;
  tracking.side = 5000;
  tracking.clutter = 60;
  const Problem problem = generate_tracking(tracking).problem;
  const auto [quick, all] = settled_by(problem);
  EXPECT_GT(quick, 50);
  EXPECT_GE(all, quick);
}

TEST(Settling, SaysWhatSettledAComponent) {
  ProblemBuilder builder({2, 2, 2});
  builder.add_arc({1, 1, 0}, -3);
  builder.add_arc({1, 1, 1}, -5);
  builder.add_arc({2, 2, 2}, -1);
  const Problem problem = std::move(builder).build();
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.cost, -6);
  EXPECT_EQ(solution.stats.settled_components, 2);
  EXPECT_EQ(solution.components[0].method, "reductions");
  EXPECT_EQ(solution.stats.tried_components, 2);
  EXPECT_EQ(solution.stats.reductions.components, 2);
  EXPECT_EQ(solution.stats.reductions.arcs, 3);
  EXPECT_EQ(solution.stats.forgotten_reductions.components, 0);
  EXPECT_EQ(solution.stats.reductions.outweighing, 2);
  EXPECT_EQ(solution.stats.reductions.excluded, 1);
  EXPECT_FALSE(solution.stats.bound_by_branching);
  EXPECT_THAT(solution.solutions.front().arcs,
              ElementsAre(ElementsAre(1, 1, 1), ElementsAre(2, 2, 2)));
}

// An arc that outweighs its one rival beside an odd cycle, which no rule opens.
TEST(Settling, SaysWhatWasInVain) {
  const Problem problem = support::make_problem(
      {2, 2, 2},
      {{{2, 2, 0}, -10}, {{0, 2, 1}, -1}, {{1, 1, 0}, -1}, {{1, 0, 1}, -1}, {{0, 1, 1}, -1}});
  const Stats stats = solve(problem).stats;
  EXPECT_EQ(stats.tried_components, 1);
  EXPECT_EQ(stats.settled_components, 0);
  EXPECT_EQ(stats.reductions.components, 0);
  EXPECT_EQ(stats.forgotten_reductions.components, 1);
  EXPECT_EQ(stats.forgotten_reductions.arcs, 5);
  EXPECT_EQ(stats.forgotten_reductions.outweighing, 1);
  EXPECT_EQ(stats.forgotten_reductions.excluded, 1);
  EXPECT_EQ(stats.forgotten_reductions.left, 3);
}

TEST(Settling, IsNotTriedWhereSingletonsAreForbidden) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 1}, -3);
  builder.add_arc({1, 0}, kInfinity);
  const Solution solution = solve(std::move(builder).build());
  EXPECT_EQ(solution.cost, -3);
  EXPECT_EQ(solution.stats.settled_components, 0);
}

TEST(Settling, IsNoPartOfTheReportsAlgorithm) {
  ProblemBuilder builder({1, 1, 1});
  builder.add_arc({1, 1, 1}, -3);
  Options options;
  options.method = Method::kRelaxation;
  const Solution solution = solve(std::move(builder).build(), options);
  EXPECT_EQ(solution.stats.settled_components, 0);
}

TEST(Settling, LeavesLargeComponentsAlone) {
  core::Component component = core::make_component({1, 1, 30000});
  for (Index i = 1; i <= 30000; ++i)
    core::append_arc(component, std::vector<Index>{1, 1, i}, -static_cast<double>(i));
  pipeline::Settler settler;
  EXPECT_FALSE(settler.settle(component, {}, Reductions::kAll).has_value());
}

}  // namespace
}  // namespace nda
