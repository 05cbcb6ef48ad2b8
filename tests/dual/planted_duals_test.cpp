#include "support/planted_duals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dual/maximize.hpp"

namespace nda::dual {
namespace {

/// Mean of log10 of the part of the gap that is left after `evaluations`, over some problems.
template <class Problem>
double mean_log_gap(const typename Problem::Size& size, DualMethod method, int evaluations) {
  constexpr int kProblems = 6;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= kProblems; ++seed) {
    Problem problem(size, seed);
    const std::vector<double> start(problem.num_variables());
    std::vector<double> unused(problem.num_variables());
    const double first = problem.evaluate(start, unused);
    MaximizeOptions options;
    options.max_evaluations = evaluations;
    const double value = maximize(method, problem, start, options).value;
    const double left = (problem.maximum() - value) / (problem.maximum() - first);
    EXPECT_GE(left, -1e-9) << "above the planted maximum, seed " << seed;
    sum += std::log10(std::max(left, 1e-9));
  }
  return sum / kProblems;
}

template <class Problem>
void expect_bundle_is_best(const typename Problem::Size& size) {
  for (const int evaluations : {10, 20, 50}) {
    SCOPED_TRACE(evaluations);
    const double bundle = mean_log_gap<Problem>(size, DualMethod::kBundleTrust, evaluations);
    EXPECT_LT(bundle, mean_log_gap<Problem>(size, DualMethod::kSubgradient, evaluations));
    EXPECT_LT(bundle, mean_log_gap<Problem>(size, DualMethod::kVolume, evaluations));
  }
}

TEST(PlantedPolyhedron, BundleTrustReachesThePlantedMaximum) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    test::PlantedPolyhedron problem({20, 10, 1000}, seed);
    const std::vector<double> start(problem.num_variables());
    const double value = maximize_bundle_trust(problem, start, {}).value;
    EXPECT_NEAR(value, problem.maximum(), 1e-6 * std::abs(problem.maximum()));
  }
}

TEST(PlantedPacking, BundleTrustReachesThePlantedMaximum) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    test::PlantedPacking problem({4, 15, 20, 1}, seed);
    const std::vector<double> start(problem.num_variables());
    const double value = maximize_bundle_trust(problem, start, {}).value;
    EXPECT_NEAR(value, problem.maximum(), 1e-6 * std::abs(problem.maximum()));
  }
}

TEST(PlantedPolyhedron, BundleTrustIsBestForFewEvaluations) {
  expect_bundle_is_best<test::PlantedPolyhedron>({50, 20, 1000});
}

TEST(PlantedPacking, BundleTrustIsBestForFewEvaluations) {
  expect_bundle_is_best<test::PlantedPacking>({4, 30, 40, 1});
}

}  // namespace
}  // namespace nda::dual
