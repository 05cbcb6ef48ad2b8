#include "solve/hot_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"

// A warm start is advice: whatever it says, the answer costs what it costs without.

namespace nda {
namespace {

double tolerance(double cost) {
  return 1e-9 * std::max(1.0, std::abs(cost));
}

// The answer with this warm start, which must be as good as without and as well proven.
Solution expect_same(const Problem& problem, const WarmStart& warm, const Options& options = {}) {
  const Solution cold = solve(problem, options);
  const Solution hot = solve(problem, options, warm);
  // Rounding is reckoned for other parts, so wildly different costs may lose precision here or
  // there alone.
  if (hot.status != Status::kPrecisionLost && cold.status != Status::kPrecisionLost) {
    EXPECT_EQ(hot.status, cold.status);
    EXPECT_EQ(hot.proven, cold.proven);
  }
  if (cold.cost != hot.cost) {
    EXPECT_NEAR(hot.cost, cold.cost, tolerance(cold.cost));
  }
  const CheckReport report = check(problem, hot);
  EXPECT_TRUE(report.passed()) << (report.faults.empty() ? "" : report.faults.front());
  return hot;
}

// Anything that fits the type: too long, too short, out of range, not finite.
WarmStart garbage(core::Random& random, const Problem& problem) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double wild[] = {
      0, -1, 1, -5, 1e300, -1e300, -1e12, 1e-12, kInfinite, -kInfinite, std::nan("")};
  WarmStart warm;
  warm.multipliers.resize(random.below(8));
  for (std::vector<double>& row : warm.multipliers) {
    row.resize(random.below(8));
    for (double& u : row) u = random.below(2) ? wild[random.below(11)] : random.uniform(-20, 5);
  }
  warm.arcs.resize(random.below(6));
  const auto dimensions = static_cast<std::uint64_t>(problem.num_dimensions());
  for (std::vector<Index>& tuple : warm.arcs) {
    tuple.resize(random.below(2) ? dimensions : random.below(9));
    for (Index& i : tuple) i = static_cast<Index>(random.below(8));
    if (random.below(9) == 0 && !tuple.empty()) tuple.front() = ~Index{0};
  }
  return warm;
}

TEST(HotStart, OfGarbageChangesNoAnswer) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    core::Random random(seed);
    expect_same(random_case.problem, garbage(random, random_case.problem));
  }
}

TEST(HotStart, FindsTheOptimumOfEnumeration) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    const Solution cold = solve(random_case.problem);
    const Solution hot = solve(random_case.problem, {}, warm_start(cold));
    const auto best = support::brute_force(random_case.problem);
    EXPECT_EQ(hot.status == Status::kInfeasible, !best);
    if (best && hot.proven) {
      EXPECT_NEAR(hot.cost, best->cost, tolerance(best->cost));
    }
  }
}

// The solution of the same problem, its tuples, dimensions and indices in disorder.
TEST(HotStart, OfPermutedIndicesChangesNoAnswer) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    core::Random random(seed);
    WarmStart warm = warm_start(solve(random_case.problem));
    for (std::vector<double>& row : warm.multipliers) core::shuffle(row, random);
    core::shuffle(warm.multipliers, random);
    for (std::vector<Index>& tuple : warm.arcs) core::shuffle(tuple, random);
    expect_same(random_case.problem, warm);
  }
}

TrackingOptions sliding(std::uint64_t seed) {
  TrackingOptions options;
  options.scans = 4;
  options.scenario_scans = 8;
  options.targets = 12;
  options.side = seed % 2 == 0 ? 400 : 900;
  options.group_size = seed % 3 == 0 ? 3 : 0;
  options.seed = seed;
  return options;
}

TEST(HotStart, OfAWindowMovedAnyWayChangesNoAnswer) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    TrackingOptions options = sliding(seed);
    const Solution first = solve(generate_tracking(options).problem);
    for (options.first_scan = 0; options.first_scan <= 4; ++options.first_scan) {
      const Problem window = generate_tracking(options).problem;
      for (const int shift : {options.first_scan, 0, 1, 5}) {
        WarmStart warm = warm_start(first);
        warm.shift(shift);
        expect_same(window, warm);
        warm.shift(1, 1);
        expect_same(window, warm);
      }
    }
  }
}

// Multipliers of some other window, a little wrong or very, in part or not at all; tuples likewise.
WarmStart spoilt(WarmStart warm, core::Random& random) {
  const double noise = random.below(3) == 0 ? 0 : std::pow(10, random.uniform(-12, 3));
  for (std::vector<double>& row : warm.multipliers) {
    if (random.below(8) == 0) row.resize(random.below(40));
    for (double& u : row) {
      u += noise * random.uniform(-1, 1);
      if (random.below(200) == 0) u = random.below(2) ? std::nan("") : 1e18;
    }
  }
  const bool mixed = random.below(4) == 0;
  for (std::vector<Index>& tuple : warm.arcs) {
    for (Index& i : tuple) {
      if (mixed && random.below(5) == 0) i = static_cast<Index>(random.below(30));
    }
  }
  if (random.below(8) == 0) warm.arcs.clear();
  if (random.below(8) == 0) warm.multipliers.clear();
  return warm;
}

TEST(HotStart, OfSpoiltWindowsChangesNoAnswer) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    core::Random random(seed);
    TrackingOptions scene = sliding(seed);
    scene.scans = 2 + static_cast<int>(random.below(5));
    scene.targets = 3 + static_cast<int>(random.below(12));
    scene.cap = 150;
    const WarmStart last = warm_start(solve(generate_tracking(scene).problem));
    scene.first_scan = static_cast<int>(random.below(3));
    const Problem window = generate_tracking(scene).problem;
    for (int trial = 0; trial < 6; ++trial) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", trial " + std::to_string(trial));
      WarmStart warm = last;
      warm.shift(static_cast<int>(random.below(3)), static_cast<int>(random.below(2)));
      Options options;
      if (random.below(8) == 0) options.relaxation.decompose = false;
      if (random.below(8) == 0) options.branch.exact_arcs = random.below(100);
      expect_same(window, spoilt(std::move(warm), random), options);
    }
  }
}

TEST(HotStart, ChangesNoAnswerOfOtherMethodsThreadsGapsAndProofs) {
  TrackingOptions scene = sliding(2);
  const Solution last = solve(generate_tracking(scene).problem);
  WarmStart warm = warm_start(last);
  warm.shift(1);
  scene.first_scan = 1;
  const Problem window = generate_tracking(scene).problem;
  Options options;
  options.num_threads = 3;
  expect_same(window, warm, options);
  options = {};
  options.method = Method::kExact;
  expect_same(window, warm, options);
  options.method = Method::kRelaxation;
  EXPECT_EQ(expect_same(window, warm, options).cost, solve(window, options).cost);
  options = {};
  options.proof = true;
  const Solution proven = expect_same(window, warm, options);
  ASSERT_TRUE(proven.proof);
  EXPECT_TRUE(check(window, proven, *proven.proof).passed());
  options = {};
  options.relative_gap = 0.02;
  const Solution near = solve(window, options, warm);
  EXPECT_LE(near.relative_gap(), 0.02);
  EXPECT_LE(near.lower_bound, solve(window).cost + 1e-9);
  EXPECT_TRUE(check(window, near).passed());
}

TEST(HotStart, KeepsBothBoundsWhateverTheLimits) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    TrackingOptions scene = sliding(2 * seed);
    scene.targets = 25;
    WarmStart warm = warm_start(solve(generate_tracking(scene).problem));
    warm.shift(1);
    scene.first_scan = 1;
    const Problem window = generate_tracking(scene).problem;
    const double best = solve(window).cost;
    for (const double limit : {1e-9, 1e-4, 3e-4, 1e-3}) {
      Options options;
      options.time_limit_s = limit;
      const Solution hot = solve(window, options, warm);
      EXPECT_LE(hot.lower_bound, best + 1e-9);
      EXPECT_GE(hot.cost, best - 1e-9);
      EXPECT_TRUE(check(window, hot).passed());
    }
    Options options;
    options.branch.max_nodes = 0;
    const Solution hot = solve(window, options, warm);
    EXPECT_LE(hot.lower_bound, best + 1e-9);
    EXPECT_TRUE(check(window, hot).passed());
  }
}

// Targets far apart: what is open after a hot start from the answer itself is next to nothing.
TEST(HotStart, LeavesLittleOpen) {
  TrackingOptions scene;
  scene.targets = 15;
  scene.side = 1500;
  scene.scenario_scans = 5;
  const Solution last = solve(generate_tracking(scene).problem);
  scene.first_scan = 1;
  const Problem window = generate_tracking(scene).problem;
  WarmStart warm = warm_start(last);
  warm.shift(1);
  const core::Shift shift = core::make_shift(window);
  const auto hot = pipeline::make_hot_start(window, shift, core::find_grid(window), warm, {});
  ASSERT_TRUE(hot);
  EXPECT_LT(hot->open.num_arcs(), hot->live.num_arcs() / 20);
  EXPECT_GT(hot->settled.size(), 10u);
  EXPECT_LE(hot->lower, solve(window).cost + 1e-9);
}

}  // namespace
}  // namespace nda
