#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "dual/maximize.hpp"
#include "support/concave_fakes.hpp"
#include "support/planted_duals.hpp"

namespace nda::dual {
namespace {

MaximizeOptions options_for(int evaluations) {
  MaximizeOptions options;
  options.max_evaluations = evaluations;
  options.primal_weights = true;
  return options;
}

// Average subgradients as the caller would average primal points: both ways must agree.
TEST(Volume, PrimalStepsBuildTheWeightsItReports) {
  test::PlantedPacking packing({4, 15, 20, 1}, 5);
  std::vector<double> average(packing.num_variables());
  std::vector<double> subgradient(packing.num_variables());
  std::vector<double> weights(150, 0.0);
  const std::vector<double> start(packing.num_variables());
  const MaximizeResult result =
      maximize_volume(packing, start, options_for(150), [&](const Iterate& it) {
        EXPECT_GE(it.primal_step, 0);
        EXPECT_LE(it.primal_step, 1);
        packing.evaluate(it.point, subgradient);
        for (std::size_t i = 0; i < average.size(); ++i) {
          average[i] += it.primal_step * (subgradient[i] - average[i]);
        }
        for (double& w : weights) w *= 1 - it.primal_step;
        weights[static_cast<std::size_t>(it.evaluation) - 1] += it.primal_step;
        return true;
      });
  const double norm2 = std::inner_product(average.begin(), average.end(), average.begin(), 0.0);
  EXPECT_NEAR(std::sqrt(norm2), result.aggregate_norm, 1e-9);
  ASSERT_EQ(result.primal_weights.size(), weights.size());
  for (std::size_t e = 0; e < weights.size(); ++e) {
    EXPECT_NEAR(result.primal_weights[e], weights[e], 1e-12);
  }
  EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-12);
}

// At the optimum the average of the subgradients 1 - (uses of an index) tends to 0: the average
// primal point covers every index once.
TEST(Volume, AveragedPrimalPointsBecomeFeasible) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE(seed);
    test::PlantedPacking packing({4, 15, 20, 1}, seed);
    const std::vector<double> start(packing.num_variables());
    const MaximizeResult early = maximize_volume(packing, start, options_for(1));
    const MaximizeResult late = maximize_volume(packing, start, options_for(300));
    EXPECT_LT(late.aggregate_norm, 0.1 * early.aggregate_norm);
    EXPECT_NEAR(late.value, packing.maximum(), 1e-3 * std::abs(packing.maximum()));
  }
}

TEST(Volume, CountsASubgradientAsLittleAsAskedFor) {
  test::PlantedPacking packing({4, 15, 20, 1}, 2);
  const std::vector<double> start(packing.num_variables());
  MaximizeOptions options = options_for(100);
  options.volume.first_alpha = 0.1;
  maximize_volume(packing, start, options, [&](const Iterate& it) {
    EXPECT_LE(it.primal_step, it.evaluation == 1 ? 1 : 0.1);
    return true;
  });
}

// How far from the start it still looks after 60 evaluations from the maximum, where none gains.
TEST(Volume, KeepsItsStepsForAsLongAsAskedFor) {
  const auto last_reach = [](int patience) {
    test::Planes roof({0, 0, 0}, {{1, 0}, {-1, 1}, {0, -1}});
    const std::vector<double> start = {0, 0};
    MaximizeOptions options = options_for(60);
    options.relative_tolerance = 0;
    options.expected_increase = 1;
    options.volume.patience = patience;
    double reach = 0;
    maximize_volume(roof, start, options, [&](const Iterate& it) {
      reach = std::hypot(it.point[0], it.point[1]);
      return true;
    });
    return reach;
  };
  EXPECT_GT(last_reach(5), 1000 * last_reach(1));
}

// Two opposed subgradients whose average vanishes far from the maximum: no convergence.
TEST(Volume, GoesOnWhereTheAverageVanishesTooEarly) {
  test::Planes planes({0, 2}, {{1}, {-1}});
  const std::vector<double> start = {-50};
  EXPECT_NEAR(maximize_volume(planes, start, options_for(300)).value, 1, 1e-2);
}

}  // namespace
}  // namespace nda::dual
