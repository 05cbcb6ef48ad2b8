#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "dual/maximize.hpp"
#include "nda/types.hpp"
#include "support/concave_fakes.hpp"
#include "support/nonsmooth_functions.hpp"
#include "support/planted_duals.hpp"

namespace nda::dual {
namespace {

using test::NegatedFunction;
using test::Planes;

std::vector<double> zeros(const ConcaveFunction& function) {
  return std::vector<double>(function.num_variables(), 0.0);
}

// q = min(u, 2 - u): the first plane says "up", the second one is found by the first trial beyond
// u = 1, and then the model is exact.
TEST(BundleTrust, SolvesATwoPlaneProblemInFourEvaluations) {
  Planes planes({0, 2}, {{1}, {-1}});
  const std::vector<double> start = {-3};
  const MaximizeResult result = maximize_bundle_trust(planes, start, {});
  EXPECT_NEAR(result.value, 1, 1e-12);
  EXPECT_NEAR(result.point[0], 1, 1e-12);
  EXPECT_EQ(result.reason, StopReason::kConverged);
  EXPECT_LE(result.evaluations, 4);
}

TEST(BundleTrust, StopsAtOnceWhereTheStartIsTheMaximumAtAKink) {
  Planes planes({0, 0}, {{1}, {-1}});
  const std::vector<double> start = {0};
  const MaximizeResult result = maximize_bundle_trust(planes, start, {});
  EXPECT_EQ(result.reason, StopReason::kConverged);
  EXPECT_LE(result.evaluations, 3);
  EXPECT_EQ(result.value, 0);
}

// The trap of false convergence: the predicted increase is far below the tolerance at this t.
TEST(BundleTrust, DoesNotMistakeATinyStepForConvergence) {
  for (const double step : {1e-20, 1e-12, 1e-6}) {
    SCOPED_TRACE(step);
    test::PlantedPacking packing({4, 20, 30, 1}, 3);
    MaximizeOptions options;
    options.initial_step = step;
    options.max_evaluations = 300;
    const MaximizeResult result = maximize_bundle_trust(packing, zeros(packing), options);
    EXPECT_NEAR(result.value, packing.maximum(), 1e-5 * std::abs(packing.maximum()));
  }
}

TEST(BundleTrust, RecoversFromAHugeStep) {
  for (const double step : {1e6, 1e12, 1e20}) {
    SCOPED_TRACE(step);
    test::PlantedPacking packing({4, 20, 30, 1}, 3);
    MaximizeOptions options;
    options.initial_step = step;
    options.max_evaluations = 300;
    const MaximizeResult result = maximize_bundle_trust(packing, zeros(packing), options);
    EXPECT_NEAR(result.value, packing.maximum(), 1e-5 * std::abs(packing.maximum()));
  }
}

// Planes of every size a number can have, repeated ones and flat ones among them.
Planes planes_of_any_size(core::Random& random) {
  constexpr double kSizes[] = {0, 5e-324, 1e-310, 1e-160, 1e-100, 1, 1e100, 1e153, 1e200, 1e300};
  const auto num_planes = static_cast<std::size_t>(1 + random.below(8));
  const auto num_variables = static_cast<std::size_t>(1 + random.below(4));
  const auto fixed = random.below(11);
  const auto draw = [&](std::uint64_t kind) {
    return kSizes[kind < 10 ? kind : random.below(10)] *
           (static_cast<double>(random.below(5)) - 2) / 2;
  };
  const auto slope_kind = random.below(11);
  std::vector<double> constants(num_planes);
  std::vector<std::vector<double>> slopes(num_planes, std::vector<double>(num_variables));
  for (std::size_t i = 0; i < num_planes; ++i) {
    constants[i] = draw(fixed);
    for (double& slope : slopes[i]) slope = draw(slope_kind);
    if (i > 0 && random.below(3) == 0) slopes[i] = slopes[random.below(i)];
  }
  return {constants, slopes};
}

TEST(BundleTrust, EndsWhateverTheSizeOfTheFunction) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    Planes planes = planes_of_any_size(random);
    MaximizeOptions options;
    options.max_evaluations = 60;
    options.relative_tolerance = random.below(2) == 0 ? 0 : 1e-7;
    const std::vector<double> start = zeros(planes);
    std::vector<double> subgradient(start.size());
    const double first = planes.evaluate(start, subgradient);
    try {
      const MaximizeResult result = maximize_bundle_trust(planes, start, options);
      EXPECT_LE(result.evaluations, 60);
      EXPECT_GE(result.value, first);
    } catch (const InputError&) {
      // An unbounded function overflows on the way up.
    }
    if (HasFailure()) return;
  }
}

// The first step, the value over the square of the slope, underflows to 0: no factor makes it grow.
TEST(BundleTrust, EndsWhereTheValueIsTheSmallestNumber) {
  Planes planes({-5e-324, 5e-324}, {{1.5}, {-1.5}});
  MaximizeOptions options;
  options.max_evaluations = 50;
  const MaximizeResult result = maximize_bundle_trust(planes, zeros(planes), options);
  EXPECT_LE(result.evaluations, 50);
  EXPECT_GE(result.value, -5e-324);
}

// q = -|x| - |y - 1000| / 1000: a steep ridge along y that t, once small for x, must outgrow.
TEST(BundleTrust, ClimbsALongFlatRidge) {
  test::Tents tents({0, 1000}, {1, 1e-3});
  const std::vector<double> start = {0.3, 0};
  const MaximizeResult result = maximize_bundle_trust(tents, start, {});
  EXPECT_NEAR(result.value, 0, 1e-6);
  EXPECT_LE(result.evaluations, 40);
}

TEST(BundleTrust, ProvesItsValueByTheAggregate) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    test::PlantedPacking packing({3, 12, 20, 1}, seed);
    MaximizeOptions options;
    options.max_evaluations = 400;
    options.relative_tolerance = 1e-6;
    const MaximizeResult result = maximize_bundle_trust(packing, zeros(packing), options);
    ASSERT_EQ(result.reason, StopReason::kConverged);
    EXPECT_NEAR(result.value, packing.maximum(), 2e-6 * std::abs(packing.maximum()));
    EXPECT_LE(result.aggregate_error, 1e-6 * std::abs(result.value));
    EXPECT_LE(result.aggregate_norm, 1e-4);
  }
}

// The aggregate, rebuilt from the evaluations by the weights, is a plane above q.
TEST(BundleTrust, ReportsTheCombinationBehindTheAggregate) {
  test::PlantedPacking packing({4, 20, 30, 1}, 11);
  MaximizeOptions options;
  options.primal_weights = true;
  options.max_evaluations = 120;
  options.bundle_size = 10;  // forces compression
  std::vector<std::vector<double>> points;
  const MaximizeResult result =
      maximize_bundle_trust(packing, zeros(packing), options, [&](const Iterate& it) {
        points.emplace_back(it.point.begin(), it.point.end());
        return true;
      });
  ASSERT_EQ(result.primal_weights.size(), 120u);
  EXPECT_NEAR(
      std::accumulate(result.primal_weights.begin(), result.primal_weights.end(), 0.0), 1, 1e-9);
  std::vector<double> aggregate(packing.num_variables());
  std::vector<double> subgradient(packing.num_variables());
  for (std::size_t e = 0; e < points.size(); ++e) {
    EXPECT_GE(result.primal_weights[e], 0);
    packing.evaluate(points[e], subgradient);
    for (std::size_t i = 0; i < aggregate.size(); ++i) {
      aggregate[i] += result.primal_weights[e] * subgradient[i];
    }
  }
  const double norm2 =
      std::inner_product(aggregate.begin(), aggregate.end(), aggregate.begin(), 0.0);
  EXPECT_NEAR(std::sqrt(norm2), result.aggregate_norm, 1e-9);
}

TEST(BundleTrust, NeedsNoMoreThanTwoSubgradients) {
  test::PlantedPacking packing({3, 8, 12, 0}, 2);
  MaximizeOptions options;
  options.bundle_size = 2;
  options.max_evaluations = 2000;
  const MaximizeResult result = maximize_bundle_trust(packing, zeros(packing), options);
  EXPECT_NEAR(result.value, packing.maximum(), 1e-2 * std::abs(packing.maximum()));
}

TEST(BundleTrust, HandlesAHundredThousandVariables) {
  const test::NonsmoothProblem problem = test::chained_lq(100000);
  NegatedFunction function = problem.negated();
  MaximizeOptions options;
  options.max_evaluations = 40;
  options.bundle_size = 10;
  const MaximizeResult result = maximize_bundle_trust(function, problem.start, options);
  EXPECT_NEAR(result.value, -problem.minimum, 1e-3 * std::abs(problem.minimum));
}

TEST(BundleTrust, ContinuesWithTheStepOfAnEarlierRun) {
  test::PlantedPacking packing({4, 30, 40, 1}, 4);
  MaximizeOptions options;
  options.max_evaluations = 60;
  const MaximizeResult first = maximize_bundle_trust(packing, zeros(packing), options);
  options.max_evaluations = 10;
  const double cold = maximize_bundle_trust(packing, first.point, options).value;
  options.initial_step = first.step;
  EXPECT_GT(maximize_bundle_trust(packing, first.point, options).value, cold);
}

}  // namespace
}  // namespace nda::dual
