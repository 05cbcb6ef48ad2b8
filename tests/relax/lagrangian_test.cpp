#include "relax/lagrangian.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "support/components.hpp"
#include "support/tiny_problems.hpp"

namespace nda::relax {
namespace {

using core::Component;
using core::Packing;
using support::sum_of;

constexpr double kTie = 1e-9;

const DualMethod kDualMethods[] = {
    DualMethod::kBundleTrust, DualMethod::kSubgradient, DualMethod::kVolume};

Packing recover_nothing(const RelaxedDual&) {
  return {};
}

// A component without a quick end: its dual value is not reached in a few evaluations.
Component slow_component() {
  support::RandomComponentOptions options;
  options.sizes = {8, 8, 8, 8};
  options.num_arcs = 200;
  return support::random_component(4, options);
}

void expect_valid(const Component& component, const LagrangianResult& result) {
  EXPECT_EQ(support::multiplier_fault(component, result.u), "");
  EXPECT_DOUBLE_EQ(result.lower, sum_of(result.u));
}

TEST(MaximizeDual, ReachesTheLpValueOfTinyProblems) {
  for (const support::TinyProblem& tiny : support::all_tiny_problems()) {
    bool forbidden = false;
    double constant = 0;
    for (int k = 0; k < tiny.problem.num_dimensions(); ++k) {
      for (const double cost : tiny.problem.singleton_costs(k)) {
        forbidden = forbidden || cost == kInfinity;
        constant += cost;
      }
    }
    if (forbidden || !tiny.lp_value || tiny.problem.num_indices() == 0) continue;
    SCOPED_TRACE(tiny.name);
    const Component component = support::whole_component(tiny.problem);
    for (const DualMethod method : kDualMethods) {
      SCOPED_TRACE(static_cast<int>(method));
      LagrangianOptions options;
      options.dual_method = method;
      options.max_evaluations = method == DualMethod::kBundleTrust ? 100 : 2000;
      const LagrangianResult result = maximize_dual(component, {}, options, {});
      expect_valid(component, result);
      EXPECT_NEAR(result.lower + constant, *tiny.lp_value, 1e-3);
      EXPECT_LE(result.lower + constant, *tiny.lp_value + kTie);
      if (method == DualMethod::kBundleTrust) {
        EXPECT_NEAR(result.lower + constant, *tiny.lp_value, 1e-6);
      }
    }
  }
}

TEST(MaximizeDual, AsksWhetherThereIsAnythingToRecover) {
  const Component component = slow_component();
  for (const bool settled : {false, true}) {
    int asked = 0;
    LagrangianOptions options;
    options.recovery_interval = 0;
    options.settle = [&](std::span<const double> u, double lower) {
      ++asked;
      EXPECT_EQ(support::multiplier_fault(component, u), "");
      EXPECT_DOUBLE_EQ(lower, sum_of(u));
      return settled;
    };
    const LagrangianResult result = maximize_dual(component, {}, options, recover_nothing);
    expect_valid(component, result);
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(result.recoveries, settled ? 0 : 1);
  }
}

TEST(MaximizeDual, BoundsRandomComponentsFromBelow) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const double best = support::best_cost(component);
    for (const DualMethod method : kDualMethods) {
      LagrangianOptions options;
      options.dual_method = method;
      options.max_evaluations = 1 + static_cast<int>(seed % 30);
      const LagrangianResult result = maximize_dual(component, {}, options, {});
      expect_valid(component, result);
      EXPECT_LE(result.lower, best + kTie);
      EXPECT_LE(result.evaluations, options.max_evaluations);
      EXPECT_EQ(result.recoveries, 0);
      EXPECT_TRUE(result.best.arcs.empty());
    }
  }
}

// The best point evaluated counts, and make_feasible lowers no bound.
TEST(MaximizeDual, ProvesAtLeastTheValueOfItsStart) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const std::vector<double> warm = support::feasible_multipliers(component, random);
    LagrangianOptions options;
    options.max_evaluations = 1 + static_cast<int>(seed % 5);
    const LagrangianResult result = maximize_dual(component, warm, options, {});
    EXPECT_GE(result.lower, sum_of(warm) - kTie);
    expect_valid(component, result);
  }
}

TEST(MaximizeDual, OfTwoDimensionsNeedsOneEvaluation) {
  const Component component = support::whole_component(
      support::make_problem({2, 2}, {{{1, 1}, -3}, {{1, 2}, -2}, {{2, 1}, -2}}));
  LagrangianOptions options;
  options.max_evaluations = 1;
  EXPECT_NEAR(maximize_dual(component, {}, options, {}).lower, -4, kTie);
}

TEST(MaximizeDual, StopsAtTheGoal) {
  const Component component = slow_component();
  LagrangianOptions options;
  options.max_evaluations = 300;
  const LagrangianResult full = maximize_dual(component, {}, options, {});
  options.goal = full.lower - 0.05 * std::abs(full.lower);
  const LagrangianResult stopped = maximize_dual(component, {}, options, {});
  EXPECT_GE(stopped.lower, options.goal);
  EXPECT_LT(stopped.evaluations, full.evaluations);
}

TEST(MaximizeDual, StopsWhenTheBoundMeetsARecoveredPacking) {
  const Component component = slow_component();
  LagrangianOptions options;
  options.max_evaluations = 300;
  const double reachable = maximize_dual(component, {}, options, {}).lower;
  Packing fake;
  fake.cost = reachable - 0.05 * std::abs(reachable);
  options.recovery_interval = 1;
  const LagrangianResult stopped =
      maximize_dual(component, {}, options, [&](const RelaxedDual&) { return fake; });
  EXPECT_LT(stopped.evaluations, 300);
  EXPECT_GE(stopped.lower, fake.cost);
  EXPECT_EQ(stopped.best.cost, fake.cost);
}

// The multipliers at every recovery of 20 evaluations.
std::vector<std::vector<double>> recovered_at(const Component& component, int interval) {
  LagrangianOptions options;
  options.max_evaluations = 20;
  options.recovery_interval = interval;
  std::vector<std::vector<double>> points;
  const LagrangianResult result = maximize_dual(component, {}, options, [&](const auto& point) {
    points.emplace_back(component.num_slots());
    point.multipliers(points.back());
    return recover_nothing(point);
  });
  EXPECT_EQ(result.evaluations, 20);
  EXPECT_EQ(static_cast<std::size_t>(result.recoveries), points.size());
  return points;
}

TEST(MaximizeDual, RecoversAtTheFirstEvaluationEveryIntervalAfterAndAtTheBest) {
  const Component component = slow_component();
  const std::vector<std::vector<double>> all = recovered_at(component, 1);
  ASSERT_EQ(all.size(), 20u);
  const std::vector<double> best = recovered_at(component, 0).at(0);
  for (const int interval : {2, 3, 7, 100}) {
    SCOPED_TRACE(interval);
    std::vector<std::vector<double>> expected;
    for (std::size_t e = 0; e < all.size(); e += static_cast<std::size_t>(interval))
      expected.push_back(all[e]);
    if (std::find(expected.begin(), expected.end(), best) == expected.end())
      expected.push_back(best);
    EXPECT_EQ(recovered_at(component, interval), expected);
  }
}

TEST(MaximizeDual, WithoutIntervalRecoversOnceAtTheBestPoint) {
  const Component component = slow_component();
  LagrangianOptions options;
  options.max_evaluations = 20;
  options.recovery_interval = 0;
  int calls = 0;
  double value_there = 0;
  const LagrangianResult result =
      maximize_dual(component, {}, options, [&](const RelaxedDual& point) {
        ++calls;
        for (const core::ArcId a : point.chosen_arcs()) value_there += component.costs[a];
        return Packing{};
      });
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(result.recoveries, 1);
  EXPECT_LT(value_there, 0) << "the point had been evaluated";
}

TEST(MaximizeDual, KeepsTheBestOfTheRecoveredPackings) {
  const Component component = slow_component();
  LagrangianOptions options;
  options.max_evaluations = 4;
  const std::vector<double> costs = {-1, -3, -2, 4};
  std::size_t call = 0;
  const LagrangianResult result = maximize_dual(component, {}, options, [&](const RelaxedDual&) {
    Packing packing;
    packing.arcs = {static_cast<core::ArcId>(call)};
    packing.cost = costs[call++];
    return packing;
  });
  EXPECT_EQ(call, 4u);
  EXPECT_EQ(result.best.cost, -3);
  EXPECT_THAT(result.best.arcs, ::testing::ElementsAre(1));
}

TEST(MaximizeDual, KeepsTheEmptyPackingWhenNoneIsBetter) {
  LagrangianOptions options;
  options.max_evaluations = 3;
  const LagrangianResult result =
      maximize_dual(slow_component(), {}, options, [](const RelaxedDual&) {
        return Packing{{0}, 2.5};
      });
  EXPECT_TRUE(result.best.arcs.empty());
  EXPECT_EQ(result.best.cost, 0);
}

TEST(MaximizeDual, ClaimsNothingWhereNoTimeIsLeft) {
  const Component component = slow_component();
  for (const DualMethod method : {DualMethod::kBundleTrust, DualMethod::kCoordinate}) {
    LagrangianOptions options;
    options.dual_method = method;
    options.certify_s = 20;
    options.deadline = core::Deadline(10);
    const LagrangianResult result = maximize_dual(component, {}, options, recover_nothing);
    EXPECT_EQ(result.evaluations, 0);
    EXPECT_EQ(result.lower, -kInfinity);
    EXPECT_TRUE(result.best.arcs.empty());
  }
}

TEST(MaximizeDual, StopsAtTheDeadlineWithAValidBound) {
  const Component component = slow_component();
  for (const DualMethod method : {DualMethod::kBundleTrust, DualMethod::kCoordinate}) {
    LagrangianOptions options;
    options.dual_method = method;
    options.max_evaluations = 1'000'000'000;
    options.relative_tolerance = 0;
    options.certify_s = 1000;
    options.deadline = core::Deadline(1000.01);
    const LagrangianResult result = maximize_dual(component, {}, options, recover_nothing);
    if (result.evaluations > 0) expect_valid(component, result);
  }
}

}  // namespace
}  // namespace nda::relax
