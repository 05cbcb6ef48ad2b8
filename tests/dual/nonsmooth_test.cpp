#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/random.hpp"
#include "dual/maximize.hpp"
#include "support/nonsmooth_functions.hpp"

namespace nda::dual {
namespace {

using test::NonsmoothProblem;

class NonsmoothTest : public ::testing::TestWithParam<NonsmoothProblem> {
 protected:
  /// (f - minimum) / max(1, |minimum|).
  double error(DualMethod method, int evaluations) const {
    test::NegatedFunction function = GetParam().negated();
    MaximizeOptions options;
    options.max_evaluations = evaluations;
    options.relative_tolerance = 1e-12;  // of f(start) - f, much larger here
    const double value = maximize(method, function, GetParam().start, options).value;
    return (-value - GetParam().minimum) / std::max(1.0, std::abs(GetParam().minimum));
  }
  /// Part of the gap at the start that is left.
  double gap_left(DualMethod method, int evaluations) const {
    test::NegatedFunction function = GetParam().negated();
    MaximizeOptions options;
    options.max_evaluations = evaluations;
    std::vector<double> unused(GetParam().size());
    const double first = function.evaluate(GetParam().start, unused);
    const double value = maximize(method, function, GetParam().start, options).value;
    return (-GetParam().minimum - value) / (-GetParam().minimum - first);
  }
};

std::string name_of(const ::testing::TestParamInfo<NonsmoothProblem>& info) {
  std::string name;
  for (const char c : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Problems,
                         NonsmoothTest,
                         ::testing::ValuesIn(test::nonsmooth_problems()),
                         name_of);

// f(y) >= f(x) + g'(y - x) at random pairs: the formula is convex and g is a subgradient.
TEST_P(NonsmoothTest, HasSubgradientsOfAConvexFunction) {
  const NonsmoothProblem& p = GetParam();
  core::Random random(1);
  std::vector<double> g(p.size());
  std::vector<double> unused(p.size());
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> x = p.start;
    std::vector<double> y = p.start;
    for (double& xi : x) xi += random.uniform(-2, 2);
    for (double& yi : y) yi += random.uniform(-2, 2);
    double bound = p.formula(x, g);
    for (std::size_t i = 0; i < x.size(); ++i) bound += g[i] * (y[i] - x[i]);
    const double value = p.formula(y, unused);
    ASSERT_GE(value, bound - 1e-9 * (1 + std::abs(value))) << "trial " << trial;
  }
}

// Minima are known to 10 digits.
TEST_P(NonsmoothTest, BundleTrustReachesTheMinimum) {
  const double reached = error(DualMethod::kBundleTrust, 250);
  EXPECT_LE(reached, 1e-7);
  EXPECT_GE(reached, -1e-9);
}

// Chained LQ has a kink in almost every one of its 1,000 variables: 100 subgradients do not average
// to 0 there.
TEST_P(NonsmoothTest, BundleTrustKnowsThatItHasConverged) {
  test::NegatedFunction function = GetParam().negated();
  MaximizeOptions options;
  options.max_evaluations = 250;
  if (GetParam().size() > static_cast<std::size_t>(options.bundle_size)) {
    GTEST_SKIP() << "more variables than subgradients kept";
  }
  const MaximizeResult result = maximize_bundle_trust(function, GetParam().start, options);
  EXPECT_EQ(result.reason, StopReason::kConverged);
}

TEST_P(NonsmoothTest, VolumeClosesNineTenthsOfTheGap) {
  EXPECT_LE(gap_left(DualMethod::kVolume, 1000), 0.1);
}

TEST_P(NonsmoothTest, SubgradientClosesHalfOfTheGap) {
  EXPECT_LE(gap_left(DualMethod::kSubgradient, 1000), 0.5);
}

}  // namespace
}  // namespace nda::dual
