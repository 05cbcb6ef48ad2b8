#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "solve/component_solver.hpp"
#include "solve/medium_problems.hpp"
#include "support/brute_force.hpp"
#include "support/components.hpp"
#include "support/random_problems.hpp"
#include "support/rebuilt.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using support::make_problem;
using ::testing::IsEmpty;

TEST(Precision, ErrorGrowsWithCostsAndIndices) {
  const core::Component component = support::whole_component(
      make_problem({2, 3, 2}, {{{1, 1, 1}, -8}, {{2, 2, 0}, 3}, {{2, 3, 2}, -1}}));
  const pipeline::Precision none = pipeline::precision_of(component, {});
  EXPECT_EQ(none.error, 0x1p-50 * 7 * 8);
  EXPECT_EQ(none.margin, none.error) << "without a grid any difference counts";
  const pipeline::Precision grid = pipeline::precision_of(component, {1, true});
  EXPECT_EQ(grid.error, none.error);
  EXPECT_EQ(grid.margin, 1 - 4 * grid.error) << "nothing lies between two grid points";
  const pipeline::Precision fine = pipeline::precision_of(component, {4 * none.error, false});
  EXPECT_EQ(fine.margin, fine.error) << "a grid finer than the rounding is none";
}

// Costs of a step each, from coarse to finer than a double holds: what is taken for a grid, the
// checker must take for one, too.
TEST(Precision, KnowsTheGridsOfTheChecker) {
  core::Random random(1);
  Options options;
  options.proof = true;
  for (int n = 0; n < 2000; ++n) {
    const double size = std::pow(10.0, random.uniform(-3, 9));
    const Problem problem = make_problem({1, 2}, {{{1, 2}, size}});
    const Solution solution = solve(problem, options);
    ASSERT_TRUE(solution.proof) << size;
    EXPECT_EQ(check_proof(problem, *solution.proof).fault, "") << size;
  }
}

// 3 x 3 x 3, only full tuples; singletons of 2 s, -s and -s cancel in every solution, so that the
// costs of the arcs alone decide.
Problem cancelling_problem(std::uint64_t seed, double s) {
  core::Random random(seed);
  ProblemBuilder builder({3, 3, 3});
  for (Index k = 0; k < 3; ++k) {
    for (Index i = 1; i <= 3; ++i) {
      std::vector<Index> tuple(3, 0);
      tuple[k] = i;
      builder.add_arc(tuple, (k == 0 ? 2 : -1) * s);
    }
  }
  for (int a = 0; a < 12; ++a) {
    std::vector<Index> tuple;
    for (int k = 0; k < 3; ++k) tuple.push_back(1 + static_cast<Index>(random.below(3)));
    builder.add_arc(tuple, -random.uniform(0, 1));
  }
  return std::move(builder).build();
}

TEST(Precision, SurvivesSingletonsThatCancel) {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const double size = std::floor(std::pow(10.0, random.uniform(3, 15)));
    const Problem problem = cancelling_problem(seed, size);
    const double best = support::brute_force(cancelling_problem(seed, 0))->cost;
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_LE(solution.lower_bound, best + 1e-12);
    EXPECT_NEAR(solution.cost, best, 1e-12);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
    if (HasFailure()) return;
  }
}

TEST(Precision, IsLostWhereTheAnswerIsSmallerThanTheRounding) {
  const Problem problem = make_problem({1, 1}, {{{1, 0}, 5e11}, {{0, 1}, 5e11}, {{1, 1}, 1e-5}});
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::kPrecisionLost);
  EXPECT_FALSE(solution.proven);
  EXPECT_EQ(solution.cost, 1e-5);
  EXPECT_LE(solution.lower_bound, 1e-5);
  EXPECT_FALSE(solution.reason.empty());
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

TEST(Precision, OfIntegersIsExact) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.sizes = {4, 4, 4};
    options.num_arcs = 25;
    options.costs = support::CostKind::kHuge;  // whole numbers up to 1e12
    const Problem problem = support::random_problem(seed, options);
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.cost, support::brute_force(problem)->cost);
  }
}

// Whatever uses index 1 of the first dimension costs less, so that the optimum is 0.
Problem balanced(const Problem& problem, double optimum) {
  return support::rebuilt(
      problem, support::sizes_of(problem), [&](support::Tuple& tuple, double& cost) {
        if (tuple[0] == 1) cost -= optimum;
      });
}

TEST(Precision, OfACostOfZeroIsExact) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.sizes = {5, 5, 5};
    options.num_arcs = 60;
    options.costs = support::CostKind::kInteger;
    const Problem problem = support::random_problem(seed, options);
    const Problem zero = balanced(problem, solve(problem).cost);
    const Solution solution = solve(zero);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_EQ(solution.cost, 0);
    EXPECT_EQ(solution.lower_bound, 0);
    EXPECT_THAT(check(zero, solution).faults, IsEmpty());
    if (HasFailure()) return;
  }
}

// Forbidden singletons are charged a penalty as large as all costs together; on a grid that hides
// nothing.
TEST(Precision, OfAGridIsNotLostToThePenalty) {
  Map3Options options;
  options.size = 40;
  const Solution dense = solve(generate_map3(options).problem);
  EXPECT_EQ(dense.status, Status::kOptimal);
  EXPECT_NEAR(dense.lower_bound, dense.cost, 1e-9) << "integers: the proof is exact";
  const Instance& decimals = planted(PlantedSingletons::kForbidden);
  const Solution solution = solve(decimals.problem);
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_NEAR(solution.cost, *decimals.optimum, 1e-9);
  EXPECT_LE(solution.lower_bound, *decimals.optimum);
  EXPECT_THAT(check(decimals.problem, solution).faults, IsEmpty());
}

// Penalties that are enough for 5,000 indices would hide differences of 2e-6; modest ones do not.
TEST(Precision, IsNotLostToThePenaltiesOfForbiddenSingletons) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    PlantedOptions options;
    options.seed = seed;
    options.miss_rate = 0;
    options.singletons = PlantedSingletons::kForbidden;
    const Instance instance = generate_planted(options);
    const core::Shift shift = core::make_shift(instance.problem);
    const core::Component component = core::whole_problem(instance.problem, shift);
    const core::CostGrid grid = core::find_grid(instance.problem);
    ASSERT_FALSE(pipeline::precision_of(component, grid).on_grid());
    const Solution solution = solve(instance.problem);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_NEAR(solution.cost, *instance.optimum, 1e-9);
    EXPECT_THAT(check(instance.problem, solution).faults, IsEmpty());
  }
}

// Near the largest double sums overflow.  There is no good answer, but no wrong one either.
TEST(Precision, IsLostWhereCostsOverflow) {
  const Problem problem =
      make_problem({2, 2}, {{{1, 1}, -1.5e308}, {{2, 2}, -1.5e308}, {{1, 2}, -1.7e308}});
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::kPrecisionLost);
  EXPECT_FALSE(solution.proven);
  EXPECT_EQ(solution.lower_bound, -kInfinity);
  EXPECT_THAT(solution.reason, ::testing::HasSubstr("1.7e+308"));
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

TEST(Precision, ThatCostsOverflowStillGivesTheSingletonsAndACertificate) {
  for (const double cost : {1e101, -1e101}) {
    const Problem problem = make_problem({1, 1}, {{{1, 1}, cost}, {{1, 0}, 2}, {{0, 1}, 3}});
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kPrecisionLost);
    EXPECT_EQ(solution.cost, 5);
    EXPECT_EQ(solution.solutions.size(), 1u);
    EXPECT_EQ(solution.lower_bound, certificate_bound(problem, {{0}, {0}}));
    EXPECT_EQ(solution.stats.certificate_bound, solution.lower_bound);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
  const Problem forbidden = make_problem({1, 1}, {{{1, 1}, 1e101}}, kInfinity);
  const Solution none = solve(forbidden);
  EXPECT_THAT(none.solutions, IsEmpty());
  EXPECT_EQ(none.cost, kInfinity);
  EXPECT_THAT(check(forbidden, none).faults, IsEmpty());
}

TEST(Precision, OfSubnormalCostsHolds) {
  for (const double cost : {-1e-300, -1e-320}) {
    const Problem problem = make_problem({1, 1}, {{{1, 1}, cost}});
    const Solution solution = solve(problem);
    EXPECT_LE(solution.lower_bound, cost);
    EXPECT_LE(solution.stats.certificate_bound, cost);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

// Too many arcs for the searches of small components; shares of the costs are 0.
TEST(Precision, OfManySubnormalCostsHolds) {
  core::Random random(1);
  ProblemBuilder builder({4, 4, 4, 4});
  for (int a = 0; a < 200; ++a) {
    std::vector<Index> tuple;
    for (int k = 0; k < 4; ++k) tuple.push_back(1 + static_cast<Index>(random.below(4)));
    builder.add_arc(tuple, -static_cast<double>(1 + random.below(9000)) * 5e-324);
  }
  const Problem problem = std::move(builder).build();
  Options options;
  options.branch.exact_arcs = 0;
  options.branch.max_nodes = 100000;
  const Solution solution = solve(problem, options);
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

TEST(Precision, HoldsForCostsOfAnyOrdinarySize) {
  for (const double size : {1e-90, 1e-30, 1e-12, 1e12, 1e30, 1e90}) {
    SCOPED_TRACE(size);
    const Problem problem = make_problem({2, 2, 2},
                                         {{{1, 1, 1}, -4 * size},
                                          {{1, 1, 2}, -5 * size},
                                          {{2, 2, 1}, -2 * size},
                                          {{2, 2, 2}, -4 * size}});
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kOptimal);
    EXPECT_DOUBLE_EQ(solution.cost, -8 * size);
    EXPECT_LE(solution.lower_bound, -8 * size);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

TEST(ComponentReport, HasNoBoundAboveItsCost) {
  Options options;
  options.method = Method::kRelaxation;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions shape;
    shape.sizes.assign(2 + seed % 4, 5);
    shape.singletons = support::SingletonKind::kForbidden;
    shape.costs = support::CostKind::kZero;
    shape.plant = true;
    options.relaxation.dual_method = static_cast<DualMethod>(seed % 3);
    for (const ComponentReport& line :
         solve(support::random_problem(seed, shape), options).components) {
      EXPECT_LE(line.lower_bound, line.cost);
    }
  }
}

}  // namespace
}  // namespace nda
