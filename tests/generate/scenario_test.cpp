#include "generate/scenario.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace nda::generate {
namespace {

TEST(DrawScans, HasTheExpectedNumberOfDetections) {
  TrackingOptions options;
  options.targets = 200;
  options.clutter = 50;
  double count = 0;
  for (options.seed = 1; options.seed <= 25; ++options.seed) {
    for (const Scan& scan : draw_scans(options)) count += static_cast<double>(scan.size());
  }
  // 100 scans of mean 180 + 50 and variance 18 + 50: five standard errors of the mean are 4.1.
  EXPECT_NEAR(count / 100, 230, 4.1);
}

TEST(DrawScans, SortsEveryScanByX) {
  for (const Scan& scan : draw_scans({})) {
    EXPECT_TRUE(std::is_sorted(
        scan.begin(), scan.end(), [](const Point& a, const Point& b) { return a.x < b.x; }));
  }
}

TEST(DrawScans, MovesTargetsOnStraightLines) {
  TrackingOptions options;
  options.targets = 1;
  options.scans = 6;
  options.detection_probability = 1 - 1e-12;
  options.clutter = 1e-9;
  options.noise = 1e-6;
  const std::vector<Scan> scans = draw_scans(options);
  for (const Scan& scan : scans) ASSERT_EQ(scan.size(), 1u);
  const double vx = scans[1][0].x - scans[0][0].x;
  const double vy = scans[1][0].y - scans[0][0].y;
  EXPECT_LE(vx * vx + vy * vy, 40.001 * 40.001);
  EXPECT_GT(vx * vx + vy * vy, 0);
  for (int s = 2; s < 6; ++s) {
    EXPECT_NEAR(scans[static_cast<std::size_t>(s)][0].x, scans[0][0].x + s * vx, 1e-4);
    EXPECT_NEAR(scans[static_cast<std::size_t>(s)][0].y, scans[0][0].y + s * vy, 1e-4);
  }
}

TEST(DrawScans, LetsGroupsMeetAtMidWindow) {
  TrackingOptions options;
  options.scans = 7;
  options.targets = 40;
  options.group_size = 40;
  options.group_spread = 5;
  options.velocity_spread = 15;
  options.detection_probability = 1 - 1e-12;
  options.clutter = 1e-9;
  options.noise = 1e-3;
  const std::vector<Scan> scans = draw_scans(options);
  const auto deviation = [&](std::size_t s) {
    double sum = 0, squares = 0;
    for (const Point& p : scans[s]) {
      sum += p.x;
      squares += p.x * p.x;
    }
    return std::sqrt(squares / 40 - sum / 40 * (sum / 40));
  };
  EXPECT_NEAR(deviation(3), 5, 2.5);
  EXPECT_NEAR(deviation(0), 45, 20);  // sqrt(5^2 + (3 * 15)^2)
  EXPECT_NEAR(deviation(6), 45, 20);
}

TEST(Scenario, WindowsSeeTheSameDetectionsWhereTheyOverlap) {
  for (const int group_size : {0, 4}) {
    TrackingOptions options;
    options.group_size = group_size;
    options.scenario_scans = 9;
    options.scans = 9;
    const std::vector<Scan> all = draw_scans(options);
    options.scans = 4;
    for (options.first_scan = 0; options.first_scan <= 5; ++options.first_scan) {
      const std::vector<Scan> window = draw_scans(options);
      ASSERT_EQ(window.size(), 4u);
      for (std::size_t s = 0; s < window.size(); ++s) {
        const Scan& scan = all[s + static_cast<std::size_t>(options.first_scan)];
        ASSERT_EQ(window[s].size(), scan.size());
        for (std::size_t j = 0; j < scan.size(); ++j) EXPECT_EQ(window[s][j].x, scan[j].x);
      }
    }
  }
}

TEST(Scenario, WindowsLieWithinTheirScenario) {
  TrackingOptions options;
  options.first_scan = 1;
  EXPECT_THROW(generate_tracking(options), InputError);
  options.scenario_scans = options.scans;
  EXPECT_THROW(generate_tracking(options), InputError);
  options.scenario_scans = options.scans + 1;
  EXPECT_NO_THROW(generate_tracking(options));
  options.first_scan = 0;
  options.scenario_scans = options.scans - 1;
  EXPECT_THROW(generate_tracking(options), InputError);
}

}  // namespace
}  // namespace nda::generate
