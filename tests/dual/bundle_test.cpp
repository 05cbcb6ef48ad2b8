#include "dual/bundle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.hpp"

namespace nda::dual {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

void insert(Bundle& bundle, const std::vector<double>& g, double error, int evaluation = 1) {
  std::copy(g.begin(), g.end(), bundle.candidate().begin());
  bundle.measure_candidate();
  bundle.insert_candidate(error, evaluation);
}

TEST(Bundle, StepsAlongItsOnlySubgradient) {
  Bundle bundle(2, 4, 0);
  insert(bundle, {3, 4}, 0);
  bundle.solve(0.5);
  EXPECT_THAT(bundle.aggregate(), Pointwise(DoubleNear(0), {3.0, 4.0}));
  EXPECT_DOUBLE_EQ(bundle.aggregate_norm2(), 25);
  EXPECT_DOUBLE_EQ(bundle.predicted_increase(), 12.5);
  EXPECT_DOUBLE_EQ(bundle.master_value(), 6.25);
}

// Planes d and 1/2 - d, t = 1: weights (5/8, 3/8) by the QP test, aggregate 1/4, error 3/16.
TEST(Bundle, BalancesTwoPlanes) {
  Bundle bundle(1, 4, 0);
  insert(bundle, {1}, 0);
  insert(bundle, {-1}, 0.5);
  bundle.solve(1);
  EXPECT_THAT(bundle.aggregate(), Pointwise(DoubleNear(1e-12), {0.25}));
  EXPECT_NEAR(bundle.aggregate_error(), 3.0 / 16, 1e-12);
  EXPECT_NEAR(bundle.predicted_increase(), 0.25, 1e-12);
}

TEST(Bundle, MeasuresTheSlopeOfTheCandidateAlongTheStep) {
  Bundle bundle(2, 4, 0);
  insert(bundle, {1, 2}, 0);
  bundle.solve(2);
  std::copy_n(std::vector<double>{3, -1}.begin(), 2, bundle.candidate().begin());
  bundle.measure_candidate();
  EXPECT_DOUBLE_EQ(bundle.candidate_slope(), 2 * (3 * 1 - 1 * 2));
}

// q(d) <= error + g'd around the old centre; around c + d0 the same plane has error + g'd0 -
// increase.
TEST(Bundle, ShiftsErrorsWithTheCentre) {
  Bundle bundle(1, 4, 0);
  insert(bundle, {2}, 1);
  bundle.solve(1);  // d = 2
  bundle.move_centre(3.5);
  EXPECT_DOUBLE_EQ(bundle.aggregate_error(), 1 + 4 - 3.5);
  bundle.solve(1);
  EXPECT_DOUBLE_EQ(bundle.aggregate_error(), 1 + 4 - 3.5);
}

TEST(Bundle, DropsTheSubgradientUnusedForLongest) {
  Bundle bundle(1, 2, 2);
  insert(bundle, {1}, 0, 1);
  insert(bundle, {5}, 100, 2);
  bundle.solve(1);
  bundle.move_centre(0.5);
  std::fill(bundle.candidate().begin(), bundle.candidate().end(), -1.0);
  bundle.measure_candidate();
  bundle.insert_candidate(0, 2);
  bundle.solve(1);
  EXPECT_EQ(bundle.size(), 2u);
  EXPECT_LT(bundle.aggregate_norm2(), 1);  // planes 1 and -1, not 5
}

// With all subgradients in use, the aggregate takes the place of one: the value of the master may
// not rise above what it was (Kiwiel's condition for convergence with a bounded bundle).
TEST(Bundle, KeepsTheModelAtTheTrialWhenItCompresses) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    Bundle bundle(6, 3, 100);
    double last = 1e300;
    for (int e = 1; e <= 60; ++e) {
      for (double& x : bundle.candidate()) x = random.uniform(-1, 1.2);
      bundle.measure_candidate();
      bundle.insert_candidate(random.uniform(0, 0.1), e);
      bundle.solve(1);
      EXPECT_LE(bundle.master_value(), last + 1e-12);
      last = bundle.master_value();
      const std::vector<double> weights = bundle.primal_weights();
      EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-9);
    }
  }
}

TEST(Bundle, TellsWhetherTheMasterWasSolved) {
  Bundle bundle(1, 4, 0);
  insert(bundle, {1}, 0);
  EXPECT_TRUE(bundle.solve(1));
  insert(bundle, {-1e200}, 0);
  EXPECT_FALSE(bundle.solve(1)) << "its square overflows";
}

// Errors relative to a step as small as a step can be.
TEST(Bundle, SolvesWhereErrorsAreHugeAgainstTheStep) {
  Bundle bundle(1, 4, 0);
  insert(bundle, {1}, 0);
  insert(bundle, {-1}, 1e10);
  EXPECT_TRUE(bundle.solve(1e-305));
  EXPECT_EQ(bundle.aggregate()[0], 1);
  EXPECT_EQ(bundle.aggregate_error(), 0);
}

// The Gram matrix after many replacements is still that of the subgradients kept: the aggregate's
// norm from the matrix agrees with that of the vector (both are used), seen through the optimum
// conditions of the master: no plane kept lies below the predicted increase at d.
TEST(Bundle, AggregateSatisfiesTheMastersConditions) {
  core::Random random(42);
  Bundle bundle(8, 5, 0);
  std::vector<std::vector<double>> planes;
  for (int e = 1; e <= 40; ++e) {
    std::vector<double> g(8);
    for (double& x : g) x = random.uniform(-1, 1);
    insert(bundle, g, 0.05);
    bundle.solve(0.7);
    const double at_d =
        0.05 + 0.7 * std::inner_product(g.begin(), g.end(), bundle.aggregate().begin(), 0.0);
    EXPECT_GE(at_d, bundle.predicted_increase() - 1e-12);
  }
}

}  // namespace
}  // namespace nda::dual
