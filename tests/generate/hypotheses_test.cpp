#include "generate/hypotheses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace nda::generate {
namespace {

constexpr double kPi = 3.14159265358979323846;

// One axis of a constant-velocity Kalman filter in matrix form.
struct Axis {
  double x[2];
  double p[2][2];

  void predict(double q) {
    const double f[2][2] = {{1, 1}, {0, 1}};
    const double noise[2][2] = {{q / 3, q / 2}, {q / 2, q}};
    double fp[2][2] = {}, next[2][2] = {};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        for (int k = 0; k < 2; ++k) fp[i][j] += f[i][k] * p[k][j];
      }
    }
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        next[i][j] = noise[i][j];
        for (int k = 0; k < 2; ++k) next[i][j] += fp[i][k] * f[j][k];
      }
    }
    std::copy(&next[0][0], &next[0][0] + 4, &p[0][0]);
    x[0] += x[1];
  }

  double variance(double noise) const { return p[0][0] + noise * noise; }

  void update(double z, double noise) {
    const double s = variance(noise);
    const double nu = z - x[0];
    const double gain[2] = {p[0][0] / s, p[1][0] / s};
    const double row[2] = {p[0][0], p[0][1]};
    for (int i = 0; i < 2; ++i) {
      x[i] += gain[i] * nu;
      for (int j = 0; j < 2; ++j) p[i][j] -= gain[i] * row[j];
    }
  }
};

Axis start(double first, double second, double gap, double noise) {
  const double r = noise * noise;
  return {{second, (second - first) / gap}, {{r, r / gap}, {r / gap, 2 * r / gap / gap}}};
}

double log_normal(double nu, double variance) {
  return -0.5 * nu * nu / variance - 0.5 * std::log(2 * kPi * variance);
}

// The definition of docs/families.md applied to one tuple; nothing if it is not gated.
std::optional<double> score(const TrackingOptions& o,
                            const std::vector<Scan>& scans,
                            const std::vector<Index>& tuple) {
  const double area = o.side * o.side;
  const double clutter = o.clutter / area;
  const double p = o.detection_probability;
  const double gate = -2 * std::log(1 - o.gate_probability);
  double log_ratio = 0;
  int seen = 0, misses = 0;
  Point first;
  Axis x{}, y{};
  for (int s = 0; s < o.scans; ++s) {
    const Index i = tuple[static_cast<std::size_t>(s)];
    if (seen >= 2) {
      x.predict(o.process_noise);
      y.predict(o.process_noise);
    }
    if (i == 0) {
      misses += seen > 0;
      continue;
    }
    if (seen > 0 && misses > o.max_misses) return std::nullopt;
    const Point z = scans[static_cast<std::size_t>(s)][i - 1];
    log_ratio += misses * std::log(1 - p);
    if (seen == 0) {
      log_ratio += std::log(p * o.targets / area / (s == 0 ? 1 : 10) / clutter);
      first = z;
    } else if (seen == 1) {
      const double gap = misses + 1;
      const double radius = gap * o.max_speed + 3 * std::sqrt(2.0) * o.noise;
      if (std::hypot(z.x - first.x, z.y - first.y) > radius) return std::nullopt;
      log_ratio += std::log(p / (kPi * radius * radius) / clutter);
      x = start(first.x, z.x, gap, o.noise);
      y = start(first.y, z.y, gap, o.noise);
    } else {
      const double s2 = x.variance(o.noise);
      const double nu_x = z.x - x.x[0], nu_y = z.y - y.x[0];
      if (nu_x * nu_x / s2 + nu_y * nu_y / s2 > gate) return std::nullopt;
      log_ratio += std::log(p / clutter) + log_normal(nu_x, s2) + log_normal(nu_y, s2);
      x.update(z.x, o.noise);
      y.update(z.y, o.noise);
    }
    ++seen;
    misses = 0;
  }
  if (seen < 2) return std::nullopt;
  return -log_ratio - std::min(misses, o.max_misses) * std::log(1 - p);
}

// All tuples of the product, scored one by one.
std::map<std::vector<Index>, double> score_all(const TrackingOptions& options,
                                               const std::vector<Scan>& scans) {
  std::map<std::vector<Index>, double> result;
  std::vector<Index> tuple(scans.size(), 0);
  while (true) {
    std::size_t k = scans.size();
    while (k > 0 && tuple[k - 1] == scans[k - 1].size()) tuple[--k] = 0;
    if (k == 0) return result;
    ++tuple[k - 1];
    if (const auto cost = score(options, scans, tuple)) result[tuple] = *cost;
  }
}

TrackingOptions few_targets(std::uint64_t seed) {
  TrackingOptions options;
  options.scans = 5;
  options.targets = 3;
  options.side = 150;
  options.clutter = 2;
  options.max_misses = static_cast<int>(seed % 3);
  options.seed = seed;
  return options;
}

TEST(Hypotheses, AreExactlyTheGatedTuplesWithTheirScores) {
  std::size_t total = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const TrackingOptions options = few_targets(seed);
    const std::vector<Scan> scans = draw_scans(options);
    const auto expected = score_all(options, scans);
    total += expected.size();
    Hypotheses hypotheses(options, scans);
    std::size_t found = 0;
    for (int s = 0; s < options.scans; ++s) {
      for (std::uint32_t j = 0; j < scans[static_cast<std::size_t>(s)].size(); ++j) {
        hypotheses.enumerate(s, j);
        found += hypotheses.size();
        for (std::size_t h = 0; h < hypotheses.size(); ++h) {
          const auto tuple = hypotheses.tuple(h);
          const auto entry = expected.find({tuple.begin(), tuple.end()});
          ASSERT_NE(entry, expected.end());
          EXPECT_NEAR(from_micro(hypotheses.cost(h)), entry->second, 1e-6);
        }
      }
    }
    EXPECT_EQ(found, expected.size());
  }
  EXPECT_GT(total, 500u);
}

TEST(Hypotheses, KeepTheCheapestInLexicographicOrder) {
  TrackingOptions options = few_targets(2);
  options.targets = 8;
  const std::vector<Scan> scans = draw_scans(options);
  Hypotheses all(options, scans);
  all.enumerate(0, 0);
  ASSERT_GT(all.size(), 5u);
  std::vector<Micro> costs;
  for (std::size_t h = 0; h < all.size(); ++h) costs.push_back(all.cost(h));
  std::sort(costs.begin(), costs.end());
  costs.resize(5);
  TrackingOptions capped_options = options;
  capped_options.cap = 5;
  Hypotheses capped(capped_options, scans);
  capped.enumerate(0, 0);
  ASSERT_EQ(capped.size(), 5u);
  std::vector<Micro> kept;
  for (std::size_t h = 0; h < 5; ++h) kept.push_back(capped.cost(h));
  EXPECT_THAT(kept, ::testing::UnorderedElementsAreArray(costs));
  for (std::size_t h = 1; h < 5; ++h) {
    const auto before = capped.tuple(h - 1), after = capped.tuple(h);
    EXPECT_TRUE(
        std::lexicographical_compare(before.begin(), before.end(), after.begin(), after.end()));
  }
}

}  // namespace
}  // namespace nda::generate
