#include "dual/maximize.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "nda/types.hpp"
#include "support/concave_fakes.hpp"
#include "support/nonsmooth_functions.hpp"
#include "support/planted_duals.hpp"

namespace nda::dual {
namespace {

using test::Planes;
using test::Scaled;
using test::Tents;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

MaximizeOptions limit(int max_evaluations) {
  MaximizeOptions options;
  options.max_evaluations = max_evaluations;
  return options;
}

std::vector<double> zeros(const ConcaveFunction& function) {
  return std::vector<double>(function.num_variables(), 0.0);
}

/// What all methods owe their caller.  The function has blocks, so that all can run on it.
class MaximizeTest : public ::testing::TestWithParam<DualMethod> {
 protected:
  MaximizeResult run(ConcaveFunction& function,
                     std::span<const double> start,
                     const MaximizeOptions& options,
                     const Observer& observer = {}) {
    return maximize(GetParam(), function, start, options, observer);
  }
  bool has_blocks_only() const { return GetParam() == DualMethod::kCoordinate; }

  test::PlantedPacking packing_{{4, 10, 12, 1}, 7};
  std::vector<double> origin_ = zeros(packing_);
};

std::string name_of(const ::testing::TestParamInfo<DualMethod>& info) {
  switch (info.param) {
    case DualMethod::kBundleTrust:
      return "BundleTrust";
    case DualMethod::kSubgradient:
      return "Subgradient";
    case DualMethod::kVolume:
      return "Volume";
    case DualMethod::kCoordinate:
      return "Coordinate";
  }
  return "";
}

INSTANTIATE_TEST_SUITE_P(Methods,
                         MaximizeTest,
                         ::testing::Values(DualMethod::kBundleTrust,
                                           DualMethod::kSubgradient,
                                           DualMethod::kVolume,
                                           DualMethod::kCoordinate),
                         name_of);

TEST_P(MaximizeTest, ReturnsThePointThatHasTheValueItReports) {
  const MaximizeResult result = run(packing_, origin_, limit(30));
  std::vector<double> subgradient(origin_.size());
  EXPECT_EQ(packing_.evaluate(result.point, subgradient), result.value);
}

TEST_P(MaximizeTest, NeverExceedsTheMaximum) {
  EXPECT_LE(run(packing_, origin_, limit(200)).value, packing_.maximum() + 1e-9);
}

TEST_P(MaximizeTest, ImprovesOnTheStart) {
  std::vector<double> subgradient(origin_.size());
  const double first = packing_.evaluate(origin_, subgradient);
  EXPECT_GT(run(packing_, origin_, limit(20)).value, first);
}

TEST_P(MaximizeTest, ReportsEveryEvaluationOnceInOrderWithAMonotoneBest) {
  int last = 0;
  double best = -std::numeric_limits<double>::infinity();
  const MaximizeResult result = run(packing_, origin_, limit(40), [&](const Iterate& it) {
    EXPECT_EQ(it.evaluation, ++last);
    EXPECT_GE(it.best_value, best);
    EXPECT_GE(it.best_value, it.value);
    EXPECT_EQ(it.point.size(), origin_.size());
    std::vector<double> subgradient(origin_.size());
    EXPECT_EQ(packing_.evaluate(it.point, subgradient), it.value);
    best = it.best_value;
    return true;
  });
  EXPECT_EQ(result.evaluations, last);
  EXPECT_EQ(result.value, best);
}

TEST_P(MaximizeTest, ObeysTheEvaluationLimitExactly) {
  for (const int evaluations : {1, 2, 3, 7}) {
    SCOPED_TRACE(evaluations);
    MaximizeOptions options = limit(evaluations);
    options.relative_tolerance = 0;
    const MaximizeResult result = run(packing_, origin_, options);
    EXPECT_EQ(result.evaluations, evaluations);
    EXPECT_EQ(result.reason, StopReason::kEvaluationLimit);
  }
}

TEST_P(MaximizeTest, StopsWhenTheObserverSaysSo) {
  const MaximizeResult result =
      run(packing_, origin_, limit(50), [](const Iterate& it) { return it.evaluation < 3; });
  EXPECT_EQ(result.evaluations, 3);
  EXPECT_EQ(result.reason, StopReason::kObserver);
}

TEST_P(MaximizeTest, StopsAtTheTarget) {
  std::vector<double> subgradient(origin_.size());
  const double first = packing_.evaluate(origin_, subgradient);
  MaximizeOptions options = limit(300);
  options.target = first + (packing_.maximum() - first) / 2;
  const MaximizeResult result = run(packing_, origin_, options);
  EXPECT_EQ(result.reason, StopReason::kTargetReached);
  EXPECT_GE(result.value, options.target);
}

TEST_P(MaximizeTest, StopsAfterOneEvaluationWhereTheSubgradientVanishes) {
  Tents tents({1, 2});
  const std::vector<double> start = {1, 2};
  const MaximizeResult result = run(tents, start, limit(50));
  EXPECT_EQ(result.reason, StopReason::kConverged);
  EXPECT_LE(result.evaluations, has_blocks_only() ? 2 : 1);
  EXPECT_EQ(result.value, 0);
}

TEST_P(MaximizeTest, SolvesAProblemWithoutVariables) {
  Tents nothing(std::vector<double>{});
  const MaximizeResult result = run(nothing, {}, limit(5));
  EXPECT_EQ(result.value, 0);
  EXPECT_EQ(result.reason, StopReason::kConverged);
}

TEST_P(MaximizeTest, FindsThePeakOfATent) {
  Tents tents({-40, 3});
  const std::vector<double> start = {0, 0};
  EXPECT_NEAR(run(tents, start, limit(400)).value, 0, 0.2);
}

TEST_P(MaximizeTest, RejectsAStartOfTheWrongLength) {
  const std::vector<double> start(origin_.size() + 1, 0.0);
  EXPECT_THAT([&] { run(packing_, start, limit(5)); },
              ThrowsMessage<InputError>(HasSubstr("start has 31 entries")));
}

TEST_P(MaximizeTest, RejectsAStartThatIsNotFinite) {
  origin_[4] = kNan;
  EXPECT_THAT([&] { run(packing_, origin_, limit(5)); },
              ThrowsMessage<InputError>(HasSubstr("start entry 5")));
}

TEST_P(MaximizeTest, RejectsOptionsOutOfRange) {
  const auto expect_rejected = [&](auto change) {
    MaximizeOptions options;
    change(options);
    EXPECT_THROW(run(packing_, origin_, options), InputError);
  };
  expect_rejected([](MaximizeOptions& o) { o.max_evaluations = 0; });
  expect_rejected([](MaximizeOptions& o) { o.relative_tolerance = -1; });
  expect_rejected([](MaximizeOptions& o) { o.relative_tolerance = kNan; });
  expect_rejected([](MaximizeOptions& o) { o.target = kNan; });
  expect_rejected([](MaximizeOptions& o) { o.bundle_size = 1; });
  expect_rejected([](MaximizeOptions& o) { o.expected_increase = -1; });
  expect_rejected([](MaximizeOptions& o) { o.initial_step = kInfinity; });
  expect_rejected([](MaximizeOptions& o) { o.volume.first_alpha = 0; });
  expect_rejected([](MaximizeOptions& o) { o.volume.first_alpha = kNan; });
  expect_rejected([](MaximizeOptions& o) { o.volume.patience = 0; });
}

/// Becomes NaN, or has a NaN in its subgradient, at the third evaluation.
class Failing : public Tents {
 public:
  explicit Failing(bool in_subgradient) : Tents({10, 20}), in_subgradient_(in_subgradient) {}
  double evaluate(std::span<const double> u, std::span<double> subgradient) override {
    const double value = Tents::evaluate(u, subgradient);
    if (++calls_ < 2) return value;
    if (in_subgradient_) subgradient[1] = kNan;
    return in_subgradient_ ? value : kNan;
  }

 private:
  bool in_subgradient_;
  int calls_ = 0;
};

TEST_P(MaximizeTest, NamesTheEvaluationThatIsNotFinite) {
  Failing value(false);
  const std::vector<double> start = {0, 0};
  EXPECT_THAT([&] { run(value, start, limit(9)); },
              ThrowsMessage<InputError>(HasSubstr("evaluation 2: q is")));
  Failing subgradient(true);
  EXPECT_THAT([&] { run(subgradient, start, limit(9)); },
              ThrowsMessage<InputError>(HasSubstr("evaluation 2: subgradient entry 2 is")));
}

/// Values at every evaluation, to compare two runs step by step.
std::vector<double> history(DualMethod method, ConcaveFunction& function, MaximizeOptions options) {
  std::vector<double> values;
  maximize(method, function, zeros(function), options, [&](const Iterate& it) {
    values.push_back(it.value);
    return true;
  });
  return values;
}

class ScalingTest : public MaximizeTest {};

INSTANTIATE_TEST_SUITE_P(Methods,
                         ScalingTest,
                         ::testing::Values(DualMethod::kBundleTrust,
                                           DualMethod::kSubgradient,
                                           DualMethod::kVolume),
                         name_of);

// Powers of two, so that not even rounding differs.
TEST_P(ScalingTest, TakesTheSameStepsWhenValuesAndVariablesAreScaled) {
  const std::vector<double> plain = history(GetParam(), packing_, limit(60));
  for (const double factor : {0x1p-30, 0x1p40}) {
    for (const double stretch : {0x1p-30, 1.0, 0x1p40}) {
      SCOPED_TRACE(factor);
      SCOPED_TRACE(stretch);
      Scaled scaled(packing_, factor, stretch, 0);
      std::vector<double> values = history(GetParam(), scaled, limit(60));
      for (double& value : values) value /= factor;
      EXPECT_EQ(values, plain);
    }
  }
}

TEST_P(ScalingTest, ReachesTheSameValueWhenAConstantIsAdded) {
  const double plain = run(packing_, origin_, limit(300)).value;
  for (const double offset : {-1e4, 100.0, 1e6}) {
    SCOPED_TRACE(offset);
    Scaled shifted(packing_, 1, 1, offset);
    const double value = run(shifted, origin_, limit(300)).value - offset;
    EXPECT_NEAR(value, plain, 0.05 * std::abs(plain));
  }
}

TEST_P(ScalingTest, WorksAtEveryScaleOfCosts) {
  for (const double factor : {1e-9, 1e-3, 1e6, 1e12}) {
    SCOPED_TRACE(factor);
    Scaled scaled(packing_, factor, 1, 0);
    const double value = run(scaled, origin_, limit(300)).value / factor;
    EXPECT_GE(value, packing_.maximum() - 0.02 * std::abs(packing_.maximum()));
  }
}

TEST_P(ScalingTest, TakesHelpFromTheExpectedIncrease) {
  test::PlantedPolyhedron polyhedron({30, 15, 500}, 5);
  Scaled shifted(polyhedron, 1, 1, 1e5);
  MaximizeOptions options = limit(30);
  const std::vector<double> start = zeros(polyhedron);
  const double blind = run(shifted, start, options).value;
  options.expected_increase = 50;
  EXPECT_GT(run(shifted, start, options).value, blind);
}

TEST_P(ScalingTest, GivesTheSameAnswerTwice) {
  EXPECT_EQ(run(packing_, origin_, limit(80)).point, run(packing_, origin_, limit(80)).point);
}

TEST(Maximize, CoordinateNeedsBlocks) {
  Planes planes({0}, {{1}});
  const std::vector<double> start = {0};
  EXPECT_THROW(maximize(DualMethod::kCoordinate, planes, start, {}), InputError);
}

}  // namespace
}  // namespace nda::dual
