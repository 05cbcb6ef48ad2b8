#include "core/shift.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "support/brute_force.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda::core {
namespace {

using support::make_problem;
using ::testing::ElementsAre;

TEST(Shift, ChargesSingletonsUpFrontAndRefundsThem) {
  const Problem problem =
      make_problem({2, 1}, {{{1, 0}, 3}, {{2, 0}, 4}, {{0, 1}, -1}, {{1, 1}, 10}, {{2, 1}, 2}});
  const Shift shift = make_shift(problem);
  EXPECT_THAT(shift.base, ElementsAre(ElementsAre(0, 3, 4), ElementsAre(0, -1)));
  EXPECT_THAT(shift.offset, ElementsAre(0, 3));
  EXPECT_EQ(shift.constant, 6);
  EXPECT_EQ(shift.penalty, 0);
  EXPECT_EQ(shifted_cost(problem, shift, 0), 10 - 3 + 1);
  EXPECT_EQ(shifted_cost(problem, shift, 1), 2 - 4 + 1);
}

TEST(Shift, PutsThePenaltyWhereTheSingletonIsForbidden) {
  const Problem problem = make_problem({2, 1}, {{{1, 0}, kInfinity}, {{2, 0}, 4}, {{1, 1}, 10}});
  const Shift shift = make_shift(problem);
  EXPECT_GT(shift.penalty, 0);
  EXPECT_THAT(shift.base, ElementsAre(ElementsAre(0, shift.penalty, 4), ElementsAre(0, 0)));
  EXPECT_EQ(shift.constant, shift.penalty + 4);
  EXPECT_EQ(shifted_cost(problem, shift, 0), 10 - shift.penalty);
}

TEST(Shift, SaysWhetherALimitedPenaltyIsEnough) {
  const Problem problem = make_problem({2, 1}, {{{1, 0}, kInfinity}, {{2, 0}, 4}, {{1, 1}, 10}});
  const Shift enough = make_shift(problem);
  EXPECT_TRUE(enough.is_enough);
  const Shift limited = make_shift(problem, {}, enough.penalty - 1.5);
  EXPECT_FALSE(limited.is_enough);
  EXPECT_EQ(limited.penalty, enough.penalty - 1);
  EXPECT_TRUE(make_shift(problem, {}, enough.penalty).is_enough);
  EXPECT_TRUE(make_shift(make_problem({1, 1}, {{{1, 1}, 3}}), {}, 1).is_enough);
}

TEST(Shift, PenaltyIsPositiveWhereAllCostsAreZero) {
  const Problem problem = make_problem({1, 1}, {{{1, 1}, 0}}, kInfinity);
  EXPECT_GT(make_shift(problem).penalty, 0);
}

TEST(Shift, KeepsIntegerCostsInteger) {
  const Problem problem = make_problem({1, 1, 1}, {{{1, 1, 1}, 7}, {{1, 1, 0}, 5}}, kInfinity);
  const Shift shift = make_shift(problem);
  EXPECT_EQ(shift.penalty, std::floor(shift.penalty));
  EXPECT_GE(shift.penalty, 1);
}

// The same problem with finite singletons everywhere: those of the charge.
Problem charged(const Problem& problem, const Shift& shift) {
  ProblemBuilder builder({problem.sizes().begin(), problem.sizes().end()});
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    builder.add_arc(problem.arc(a), problem.costs()[a]);
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      std::vector<Index> tuple(problem.sizes().size(), 0);
      tuple[static_cast<std::size_t>(k)] = i;
      builder.add_arc(tuple, shift.base[static_cast<std::size_t>(k)][i]);
    }
  }
  return std::move(builder).build();
}

// Over all choices of arcs: those that leave a forbidden index uncovered are dearer than all others
// once the penalty is charged.
TEST(Shift, PenaltySeparatesFeasibleSolutionsFromAllOthers) {
  int num_separated = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    support::RandomProblemOptions options;
    options.sizes.assign(2 + random.below(3), 1 + static_cast<Index>(random.below(2)));
    options.num_arcs = static_cast<int>(random.below(9));
    options.singletons =
        random.below(2) == 0 ? support::SingletonKind::kMixed : support::SingletonKind::kForbidden;
    options.costs = static_cast<support::CostKind>(random.below(7));
    options.sign = static_cast<support::SignKind>(random.below(3));
    options.plant = true;
    SCOPED_TRACE(seed);
    const Problem problem = support::random_problem(seed, options);
    const Shift shift = make_shift(problem);
    double dearest_feasible = -kInfinity;
    double cheapest_other = kInfinity;
    for (const auto& solution : support::all_solutions(charged(problem, shift))) {
      if (support::infeasibility(problem, solution.arcs).empty()) {
        dearest_feasible = std::max(dearest_feasible, solution.cost);
      } else {
        cheapest_other = std::min(cheapest_other, solution.cost);
      }
    }
    EXPECT_LT(dearest_feasible, cheapest_other);
    num_separated += dearest_feasible > -kInfinity && cheapest_other < kInfinity;
  }
  EXPECT_GT(num_separated, 300) << "the cases must show both kinds";
}

TEST(Shift, CostOfAnyChoiceIsTheConstantPlusItsShiftedCosts) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    support::RandomProblemOptions options;
    options.num_arcs = 6;
    options.singletons = support::SingletonKind::kPriced;
    options.sign = support::SignKind::kMixed;
    SCOPED_TRACE(seed);
    const Problem problem = support::random_problem(seed, options);
    const Shift shift = make_shift(problem);
    for (const auto& solution : support::all_solutions(problem)) {
      double cost = shift.constant;
      for (const auto& arc : solution.arcs)
        cost += shifted_cost(problem, shift, *problem.find(arc));
      EXPECT_NEAR(cost, solution.cost, 1e-11);
    }
  }
}

CostGrid grid_of(std::vector<double> costs) {
  ProblemBuilder builder({1, static_cast<Index>(costs.size())});
  for (Index i = 1; i <= costs.size(); ++i) builder.add_arc({1, i}, costs[i - 1]);
  return find_grid(std::move(builder).build());
}

TEST(CostGrid, OfIntegersIsOneAndExact) {
  const CostGrid grid = grid_of({3, -17, 0, 1e12});
  EXPECT_EQ(grid.step, 1);
  EXPECT_TRUE(grid.exact);
}

TEST(CostGrid, OfAProblemWithoutArcsIsExact) {
  EXPECT_TRUE(find_grid(make_problem({2, 1}, {})).exact);
}

TEST(CostGrid, FindsTheFewestDecimals) {
  double step = 1;
  for (int digits = 1; digits <= 9; ++digits) {
    step /= 10;
    SCOPED_TRACE(digits);
    Random random(static_cast<std::uint64_t>(digits));
    std::vector<double> costs = {7 / std::pow(10.0, digits)};
    for (int i = 0; i < 20; ++i) {
      const double integer = std::floor(random.uniform(-5e4, 5e4));
      costs.push_back(integer / std::pow(10.0, digits));
    }
    const CostGrid grid = grid_of(costs);
    EXPECT_NEAR(grid.step, step, 1e-15 * step);
    EXPECT_FALSE(grid.exact);
  }
}

TEST(CostGrid, SeesTheSingletonsToo) {
  const CostGrid grid = find_grid(make_problem({1, 1}, {{{1, 1}, 3}, {{1, 0}, 0.25}}));
  EXPECT_NEAR(grid.step, 0.01, 1e-17);
  EXPECT_FALSE(grid.exact);
}

TEST(CostGrid, PassesOverForbiddenSingletons) {
  EXPECT_EQ(find_grid(make_problem({1, 1}, {{{1, 1}, 3}}, kInfinity)).step, 1);
}

TEST(CostGrid, IsNoneForCostsWithoutDecimals) {
  EXPECT_EQ(grid_of({1.0 / 3}).step, 0);
  EXPECT_EQ(grid_of({3, std::sqrt(2.0)}).step, 0);
  EXPECT_EQ(grid_of({1e-10}).step, 0) << "ten decimals";
  EXPECT_EQ(grid_of({1e-300}).step, 0);
}

TEST(CostGrid, IsNoneForCostsTooLargeToBeExact) {
  EXPECT_EQ(grid_of({0x1p60}).step, 0);
  EXPECT_EQ(grid_of({1e300}).step, 0);
  EXPECT_EQ(grid_of({1e15 + 0.5}).step, 0) << "in tenths it has too many digits";
}

TEST(CostGrid, EveryCostIsWithinOneRoundingOfAMultiple) {
  int num_grids = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const CostGrid grid = find_grid(random.problem);
    if (grid.step == 0) continue;
    ++num_grids;
    for (const double cost : random.problem.costs()) {
      const long double multiple = std::nearbyint(static_cast<long double>(cost) / grid.step);
      EXPECT_LE(std::abs(multiple * grid.step - cost), std::abs(cost) * 0x1p-51);
      if (grid.exact) {
        EXPECT_EQ(cost, std::nearbyint(cost));
      }
    }
  }
  EXPECT_GT(num_grids, 500);
}

}  // namespace
}  // namespace nda::core
