#include "cutting/dive.hpp"

#include <gtest/gtest.h>

#include "cutting/cutting_support.hpp"
#include "cutting/master_slack.hpp"

namespace nda::cutting {
namespace {

using core::Component;
using core::Packing;

constexpr double kTie = 1e-7;

TEST(Dive, EndsInAPackingAndLeavesTheMasterAsItWas) {
  int num_best = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    Master master(component, all_arcs(component), no_multipliers(component));
    ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
    const double lower = master.lower();
    core::Random random(seed);
    const Packing found = dive(component, master, random, {});
    ASSERT_EQ(support::packing_fault(component, found), "");
    ASSERT_GE(found.cost, lower - kTie);
    ASSERT_NEAR(master.lower(), lower, kTie);
    for (const core::ArcId a : all_arcs(component)) ASSERT_FALSE(master.forbidden(a));
    num_best += found.cost < support::best_cost(component) + kTie;
  }
  EXPECT_GT(num_best, 100);
}

TEST(Dive, ReachesTheOptimumOfTheTriangle) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
  core::Random random(1);
  EXPECT_EQ(dive(component, master, random, {}).cost, -1);
}

TEST(Dive, IsEmptyAfterTheDeadline) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
  core::Random random(1);
  EXPECT_TRUE(dive(component, master, random, core::Deadline(0.0)).arcs.empty());
}

// Optimum -1, multipliers -1/2 each and gap 1/2; with the cut over all three, -1 and no gap.
TEST(MasterSlack, IsCostBeyondTheBound) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  for (const double slack : {0.5, 0.0}) {
    ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
    const MasterSlack translated(component, master);
    EXPECT_NEAR(translated.base(), -1 - slack, kTie);
    const bnb::SlackResult found =
        bnb::search_slack(translated.problem(translated.affordable(1)), 1, {});
    EXPECT_NEAR(found.slack, slack, kTie);
    master.add({{1, 3, 5}, {1, 1, 1}, 2});
  }
}

}  // namespace
}  // namespace nda::cutting
