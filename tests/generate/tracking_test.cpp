#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nda/baselines.hpp"
#include "nda/generate.hpp"

namespace nda {
namespace {

using ::testing::HasSubstr;

TEST(Tracking, HasFiniteCostsOfSixDecimalsAndFreeSingletons) {
  const Problem problem = generate_tracking().problem;
  EXPECT_GT(problem.num_arcs(), 300u);
  EXPECT_EQ(problem.num_duplicates(), 0u);
  for (const double cost : problem.costs()) {
    EXPECT_LT(std::abs(cost), 100);
    EXPECT_NEAR(cost * 1e6, std::round(cost * 1e6), 1e-4);
  }
  for (int k = 0; k < 4; ++k) EXPECT_THAT(problem.singleton_costs(k), ::testing::Each(0));
}

TEST(Tracking, IsWorthMoreWithMoreTargets) {
  TrackingOptions options;
  const double few = solve_greedy(generate_tracking(options).problem).cost;
  options.targets = 60;
  options.side *= std::sqrt(3.0);
  EXPECT_LT(solve_greedy(generate_tracking(options).problem).cost, 2 * few);
}

TEST(Tracking, KeepsAtMostCapHypothesesPerStart) {
  TrackingOptions options;
  options.cap = 3;
  const Problem problem = generate_tracking(options).problem;
  std::vector<int> starts(problem.size(0) + std::size_t{1}, 0);
  for (const Index i : problem.indices(0)) ++starts[i];
  for (std::size_t i = 1; i < starts.size(); ++i) EXPECT_LE(starts[i], 3);
}

TEST(Tracking, NamesTheCommandThatMakesItAgain) {
  TrackingOptions options = tracking_preset("hard6");
  options.seed = 4;
  EXPECT_THAT(generate_tracking(options).comments[0],
              HasSubstr("nda generate groups --seed 4 --scans 6 --targets 30 --side 1500 "));
}

TEST(Tracking, RejectsOptionsOutOfRange) {
  const auto rejects = [](auto change) {
    TrackingOptions options;
    change(options);
    EXPECT_THROW(generate_tracking(options), InputError);
  };
  rejects([](TrackingOptions& o) { o.scans = 1; });
  rejects([](TrackingOptions& o) { o.targets = 0; });
  rejects([](TrackingOptions& o) { o.side = 0; });
  rejects([](TrackingOptions& o) { o.clutter = 0; });
  rejects([](TrackingOptions& o) { o.detection_probability = 1; });
  rejects([](TrackingOptions& o) { o.noise = std::nan(""); });
  rejects([](TrackingOptions& o) { o.max_speed = -1; });
  rejects([](TrackingOptions& o) { o.gate_probability = 1; });
  rejects([](TrackingOptions& o) { o.max_misses = -1; });
  rejects([](TrackingOptions& o) { o.cap = -1; });
  EXPECT_THROW(tracking_preset("enormous"), InputError);
}

}  // namespace
}  // namespace nda
