#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/build_kind.hpp"
#include "support/many_to_one_problems.hpp"
#include "support/merged_tracks.hpp"

namespace nda {
namespace {

using support::best_of_all;
using support::BoundedKind;
using support::random_bounded_problem;
using ::testing::HasSubstr;

std::optional<double> cost_of(const Problem& problem, const Solution& solution) {
  std::vector<std::size_t> arcs;
  for (const auto& tuple : solution.solutions.front().arcs) arcs.push_back(*problem.find(tuple));
  const auto cost = support::cost_of_choice(problem, arcs);
  if (!cost) return std::nullopt;
  return static_cast<double>(*cost);
}

// Everything that an optimal answer says is true.
void expect_optimum(const Problem& problem, const Solution& solution, double optimum) {
  const double tolerance = 1e-9 * std::max(1.0, std::abs(optimum));
  ASSERT_STREQ(to_string(solution.status), "optimal") << solution.reason;
  EXPECT_TRUE(solution.proven);
  EXPECT_NEAR(solution.cost, optimum, tolerance);
  EXPECT_LE(solution.lower_bound, solution.cost);
  EXPECT_NEAR(solution.lower_bound, optimum, tolerance);
  const auto recomputed = cost_of(problem, solution);
  ASSERT_TRUE(recomputed.has_value());
  EXPECT_NEAR(*recomputed, solution.cost, tolerance);
  EXPECT_LE(solution.stats.certificate_bound, optimum + tolerance);
  EXPECT_NEAR(solution.stats.certificate_bound,
              support::bound_of(problem, solution.multipliers),
              tolerance);
}

struct Count {
  int infeasible = 0;
  int feasible = 0;
};

void compare(const BoundedKind& kind, std::uint64_t seed, Count& count) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Problem problem = random_bounded_problem(seed, kind);
  const auto optimum = best_of_all(problem);
  const Solution solution = solve(problem);
  const CheckReport report = check(problem, solution);
  EXPECT_TRUE(report.passed()) << report.faults.front();
  if (optimum) {
    ++count.feasible;
    expect_optimum(problem, solution, *optimum);
  } else {
    ++count.infeasible;
    EXPECT_STREQ(to_string(solution.status), "infeasible");
    EXPECT_EQ(solution.lower_bound, kInfinity);
    EXPECT_FALSE(solution.reason.empty());
  }
}

class ManyToOne : public ::testing::TestWithParam<int> {};

TEST_P(ManyToOne, AgreesWithAllSubsets) {
  Count count;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    BoundedKind kind;
    kind.dimensions = GetParam();
    kind.num_arcs = 7 + static_cast<int>(seed % 8);
    kind.tight = seed % 5 < 2;
    kind.integer = seed % 2 == 0;
    kind.forbidding = seed % 3 == 0;
    compare(kind, seed, count);
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(count.infeasible, 20);
  EXPECT_GT(count.feasible, 400);
}

// A linear program does not take costs beyond 1e25.
TEST(ManyToOneCosts, MayHaveAnySize) {
  BoundedKind kind;
  kind.integer = false;
  kind.tight = true;
  Count count;
  for (const double size : {0x1p-300, 0x1p-40, 0x1p80, 0x1p300}) {
    kind.size = size;
    for (std::uint64_t seed = 0; seed < 20; ++seed) compare(kind, seed, count);
  }
  EXPECT_GT(count.feasible, 20);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ManyToOne, ::testing::Values(2, 3, 4, 5));

// Track 1 and 2 are certain (no singleton), and the only measurement may be used once.
TEST(ManyToOneTiny, SaysWhichIndicesCannotAllBeUsed) {
  ProblemBuilder builder({2, 1, 2});
  for (Index t = 1; t <= 2; ++t) {
    builder.add_arc({t, 0, 0}, kInfinity);
    builder.add_arc({t, 1, 0}, -1.0);
    builder.add_arc({t, 1, t}, -2.0);
    builder.set_use_bounds(0, t, {1, 2});
  }
  const Solution solution = solve(std::move(builder).build());
  EXPECT_STREQ(to_string(solution.status), "infeasible");
  EXPECT_EQ(solution.reason,
            "index 1 of dimension 1, index 2 of dimension 1 cannot all be used as often as they "
            "must: 1 use is missing at least");
  EXPECT_TRUE(solution.multipliers.empty());
}

// Two tracks share measurement 1, which may be used twice: -5 - 4 = -9, and its multiplier is 0.
// Used once it would be -5 and 0.
TEST(ManyToOneTiny, SharesAMeasurement) {
  for (const Index hi : {1u, 2u}) {
    ProblemBuilder builder({2, 1});
    builder.add_arc({1, 1}, -5.0);
    builder.add_arc({2, 1}, -4.0);
    builder.set_use_bounds(1, 1, {0, hi});
    const Solution solution = solve(std::move(builder).build());
    EXPECT_STREQ(to_string(solution.status), "optimal");
    EXPECT_EQ(solution.cost, hi == 2 ? -9 : -5);
    EXPECT_NEAR(solution.lower_bound, solution.cost, 1e-8);
  }
}

// Bounds 2..4 with a singleton of -1 and one arc of -3: the arc and three singletons, -6.
TEST(ManyToOneTiny, LeavesAloneAsOftenAsItPays) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 0}, -1.0);
  builder.add_arc({1, 1}, -3.0);
  builder.set_use_bounds(0, 1, {2, 4});
  const Solution solution = solve(std::move(builder).build());
  EXPECT_EQ(solution.cost, -6);
  EXPECT_NEAR(solution.lower_bound, -6, 1e-8);
}

TEST(ManyToOneTiny, RefusesProofsAndAlignments) {
  ProblemBuilder builder({1, 2});
  builder.add_arc({1, 1}, -3.0);
  builder.set_use_bounds(1, 2, {0, 2});
  const Problem problem = std::move(builder).build();
  Options options;
  options.proof = true;
  try {
    solve(problem, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("index 2 of dimension 2"));
  }
  options.proof = false;
  options.ranking.method = RankingMethod::kAlignments;
  EXPECT_THROW(solve_k_best(problem, 2, options), InputError);
}

TEST(ManyToOneTiny, RefusesOptionsThatItWouldIgnore) {
  ProblemBuilder builder({1, 2});
  builder.add_arc({1, 1}, -3.0);
  builder.set_use_bounds(1, 2, {0, 2});
  const Problem problem = std::move(builder).build();
  const auto refused = [&](void (*set)(RelaxationOptions&), const std::string& name) {
    Options options;
    set(options.relaxation);
    try {
      solve(problem, options);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(),
                "option relaxation." + name +
                    " cannot deal with bounds on uses: index 2 of dimension 2 has bounds 0..2");
    }
  };
  refused([](auto& r) { r.set_order = SetOrder::kProbe; }, "set_order");
  refused([](auto& r) { r.recovery_order = SetOrder::kLargestFirst; }, "recovery_order");
  refused([](auto& r) { r.alignment = AlignmentRule::kLeastViolation; }, "alignment");
  refused([](auto& r) { r.inner_evaluations = 1; }, "inner_evaluations");
}

Problem medium(std::uint64_t seed, int tracks = 40) {
  return support::merged_tracks(tracks, seed);
}

// Costs times 2, plus an amount for every use of an index, and arcs in another order of dimensions:
// all change the optimum as they must.
Problem changed(const Problem& problem, double factor, double per_use, bool reversed) {
  std::vector<Index> sizes(problem.sizes().begin(), problem.sizes().end());
  if (reversed) std::reverse(sizes.begin(), sizes.end());
  ProblemBuilder builder(sizes);
  const int n = problem.num_dimensions();
  const auto place = [&](int k) { return reversed ? n - 1 - k : k; };
  const auto add = [&](std::vector<Index> tuple, double cost) {
    if (tuple[0] != 0) cost += per_use / factor;
    if (reversed) std::reverse(tuple.begin(), tuple.end());
    builder.add_arc(tuple, cost * factor);
  };
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) add(problem.arc(a), problem.costs()[a]);
  for (int k = 0; k < n; ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      std::vector<Index> tuple(static_cast<std::size_t>(n), 0);
      tuple[static_cast<std::size_t>(k)] = i;
      add(tuple, problem.singleton_costs(k)[i]);
      builder.set_use_bounds(place(k), i, problem.use_bounds(k, i));
    }
  }
  return std::move(builder).build();
}

TEST(ManyToOneMetamorphic, CostFollowsTheProblem) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = medium(seed);
    const Solution solution = solve(problem);
    ASSERT_STREQ(to_string(solution.status), "optimal");
    EXPECT_TRUE(check(problem, solution).passed());
    const double cost = solution.cost;
    EXPECT_NEAR(solve(changed(problem, 2, 0, false)).cost, 2 * cost, 1e-8 * std::abs(cost));
    EXPECT_NEAR(solve(changed(problem, 1, 0, true)).cost, cost, 1e-8 * std::abs(cost));
    // Dimension 1 is used once each.
    EXPECT_NEAR(solve(changed(problem, 1, 5, false)).cost,
                cost + 5.0 * problem.size(0),
                1e-8 * std::abs(cost));
  }
}

// Each index twice, in two copies that share nothing.
TEST(ManyToOneMetamorphic, CopiesCostTwice) {
  const Problem problem = medium(7);
  std::vector<Index> sizes(problem.sizes().begin(), problem.sizes().end());
  std::vector<Index> doubled = sizes;
  for (Index& size : doubled) size *= 2;
  ProblemBuilder builder(doubled);
  for (const Index copy : {0u, 1u}) {
    const auto moved = [&](std::vector<Index> tuple) {
      for (std::size_t k = 0; k < tuple.size(); ++k)
        tuple[k] += tuple[k] != 0 ? copy * sizes[k] : 0;
      return tuple;
    };
    for (std::size_t a = 0; a < problem.num_arcs(); ++a)
      builder.add_arc(moved(problem.arc(a)), problem.costs()[a]);
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        std::vector<Index> tuple(sizes.size(), 0);
        tuple[static_cast<std::size_t>(k)] = i;
        builder.add_arc(moved(tuple), problem.singleton_costs(k)[i]);
        builder.set_use_bounds(
            k, i + copy * sizes[static_cast<std::size_t>(k)], problem.use_bounds(k, i));
      }
    }
  }
  const Problem both = std::move(builder).build();
  EXPECT_NEAR(solve(both).cost, 2 * solve(problem).cost, 1e-6);
}

TEST(ManyToOneLimits, KeepsBothBoundsAtEveryLimit) {
  const Problem problem = medium(3, 100);
  const double best = solve(problem).cost;
  for (const double seconds : {1e-7, 1e-3, 3e-3, 1e-2}) {
    Options options;
    options.time_limit_s = seconds;
    const Solution solution = solve(problem, options);
    EXPECT_LE(solution.lower_bound, best + 1e-8);
    EXPECT_GE(solution.cost, best - 1e-8);
    EXPECT_LT(solution.stats.solve_seconds, seconds + 0.05 * support::kSlowdown);
    EXPECT_TRUE(check(problem, solution).passed());
  }
  for (const std::int64_t nodes : {0, 1, 3}) {
    Options options;
    options.branch.max_nodes = nodes;
    const Solution solution = solve(problem, options);
    EXPECT_LE(solution.lower_bound, best + 1e-8);
    EXPECT_GE(solution.cost, best - 1e-8);
    EXPECT_TRUE(check(problem, solution).passed());
  }
  Options options;
  options.method = Method::kRelaxation;
  const Solution relaxed = solve(problem, options);
  EXPECT_LE(relaxed.lower_bound, best + 1e-8);
  EXPECT_LT(relaxed.cost - relaxed.lower_bound, 0.2 * std::abs(best));
}

// The report's algorithm with any number of kept sets and every recovery: bounds hold, and what it
// recovers is near them.
TEST(ManyToOneRelaxation, HoldsForEveryNumberOfKeptSetsAndRecovery) {
  int closed = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    BoundedKind kind;
    kind.dimensions = 3 + static_cast<int>(seed % 3);
    kind.num_arcs = 14;
    kind.tight = seed % 2 == 0;
    kind.integer = false;
    const Problem problem = random_bounded_problem(seed, kind);
    const double optimum = *best_of_all(problem);
    for (const int kept : {0, 1, 2, 3, 64}) {
      for (const RecoveryMethod recovery : {RecoveryMethod::kRecursive,
                                            RecoveryMethod::kDualGreedy,
                                            RecoveryMethod::kLocalSearch}) {
        Options options;
        options.method = Method::kRelaxation;
        options.relaxation.kept_sets = kept;
        options.relaxation.recovery = recovery;
        options.relaxation.kept_exact_arcs = seed % 4 < 2 ? 2000 : 0;
        options.search.local_search = seed % 3 != 0;
        const Solution solution = solve(problem, options);
        EXPECT_TRUE(check(problem, solution).passed());
        EXPECT_LE(solution.lower_bound, optimum + 1e-8);
        EXPECT_GE(solution.cost, optimum - 1e-8);
        closed += solution.cost < optimum + 1e-8 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(closed, 60 * 15 * 9 / 10);
}

// Three arcs at -1 that exclude each other pairwise over the first three sets; indices of the
// fourth may be used twice.  With two sets kept they count one and a half times, with three once.
TEST(ManyToOneRelaxation, ClosesAGapWithThreeKeptSets) {
  ProblemBuilder builder({1, 1, 1, 2});
  builder.add_arc({0, 1, 1, 1}, -1.0);
  builder.add_arc({1, 0, 1, 2}, -1.0);
  builder.add_arc({1, 1, 0, 1}, -1.0);
  for (const Index i : {1u, 2u}) builder.set_use_bounds(3, i, {0, 2});
  builder.add_arc({0, 0, 1, 1}, -0.1);
  builder.add_arc({0, 1, 0, 1}, -0.1);
  const Problem problem = std::move(builder).build();
  Options options;
  options.method = Method::kRelaxation;
  const Solution two = solve(problem, options);
  options.relaxation.kept_sets = 3;
  const Solution three = solve(problem, options);
  EXPECT_NEAR(two.cost, *best_of_all(problem), 1e-9);
  EXPECT_LT(two.lower_bound, two.cost - 0.1);
  EXPECT_GT(three.lower_bound, two.lower_bound + 0.1);
  EXPECT_TRUE(check(problem, three).passed());
}

// Two kept sets have the bound of the linear relaxation, cells that are used several times or not.
TEST(ManyToOneRelaxation, ReachesTheLinearRelaxation) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    BoundedOptions family;
    family.dimensions = 4;
    family.size = 20;
    family.arcs = 600;
    family.seed = seed;
    const Problem problem = generate_bounded(family).problem;
    Options options;
    options.branch.max_nodes = 0;
    options.method = Method::kExact;
    const double linear = solve(problem, options).stats.certificate_bound;
    options.method = Method::kRelaxation;
    const double relaxed = solve(problem, options).stats.certificate_bound;
    EXPECT_GE(relaxed, linear - 1e-3 * std::abs(linear)) << seed;
    EXPECT_LE(relaxed, linear + 1e-6 * std::abs(linear)) << seed;
  }
}

// Wherever the deadline strikes, splitting included.
TEST(ManyToOneLimits, HoldsAtAnyDeadline) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_bounded_problem(seed, {.num_arcs = 10, .tight = true});
    Options options;
    options.time_limit_s = 1e-6 * static_cast<double>(1 + seed % 60);
    const Solution solution = solve(problem, options);
    const double optimum = best_of_all(problem).value_or(kInfinity);
    EXPECT_LE(solution.lower_bound, optimum + 1e-9);
    EXPECT_GE(solution.cost, optimum - 1e-9);
    EXPECT_TRUE(check(problem, solution).passed());
  }
}

TEST(ManyToOneLimits, StopsAtTheGap) {
  const Problem problem = medium(3, 100);
  Options options;
  options.relative_gap = 0.3;
  const Solution solution = solve(problem, options);
  EXPECT_LE(solution.relative_gap(), 0.3);
  EXPECT_TRUE(check(problem, solution).passed());
}

TEST(ManyToOneLimits, StopsWhenTold) {
  const Problem problem = medium(3, 100);
  Options options;
  options.progress = [](const Progress&) { return false; };
  const Solution solution = solve(problem, options);
  EXPECT_STREQ(to_string(solution.status), "interrupted");
  EXPECT_TRUE(check(problem, solution).passed());
}

TEST(ManyToOneLimits, TellsOfProgressThatNeverGoesBack) {
  const Problem problem = medium(5, 100);
  Progress last;
  Options options;
  options.progress = [&](const Progress& now) {
    EXPECT_LE(now.cost, last.cost + 1e-6);
    EXPECT_GE(now.lower_bound, last.lower_bound - 1e-6);
    EXPECT_GE(now.components_done, last.components_done);
    last = now;
    return true;
  };
  const Solution solution = solve(problem, options);
  EXPECT_NEAR(last.cost, solution.cost, 1e-6);
}

// Whatever a warm start says, the answer is the same.
TEST(ManyToOneWarmStart, IsNeverTrusted) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    BoundedKind kind;
    kind.dimensions = 2 + static_cast<int>(seed % 4);
    kind.num_arcs = 12;
    kind.tight = seed % 2 == 0;
    kind.forbidding = seed % 3 == 0;
    const Problem problem = random_bounded_problem(seed, kind);
    const Solution cold = solve(problem);
    core::Random random(seed);
    WarmStart warm = warm_start(cold);
    for (std::vector<double>& u : warm.multipliers) {
      for (double& one : u) one += random.below(4) == 0 ? random.uniform(-1e6, 1e6) : 0.0;
      if (random.below(3) == 0) u.push_back(kInfinity);
    }
    for (std::vector<Index>& tuple : warm.arcs) {
      for (Index& i : tuple) i = random.below(3) == 0 ? static_cast<Index>(random.below(9)) : i;
      if (random.below(4) == 0) tuple.pop_back();
    }
    warm.arcs.emplace_back();
    const Solution solution = solve(problem, {}, warm);
    EXPECT_STREQ(to_string(solution.status), to_string(cold.status));
    if (cold.status != Status::kInfeasible) {
      EXPECT_NEAR(solution.cost, cold.cost, 1e-9);
    }
    EXPECT_TRUE(check(problem, solution).passed());
  }
}

// A problem's own solution is found at once: next to no evaluations, hardly any nodes.
TEST(ManyToOneWarmStart, SavesWork) {
  const Problem problem = medium(3, 150);
  const Solution cold = solve(problem);
  const Solution warm = solve(problem, {}, warm_start(cold));
  EXPECT_NEAR(warm.cost, cold.cost, 1e-9);
  EXPECT_STREQ(to_string(warm.status), "optimal");
  EXPECT_LT(warm.stats.dual_evaluations, cold.stats.dual_evaluations / 2);
  EXPECT_LE(warm.stats.nodes, cold.stats.nodes);
}

TEST(ManyToOneThreads, ChangeNothing) {
  const Problem problem = medium(9, 150);
  Options options;
  const Solution one = solve(problem, options);
  options.num_threads = 2;
  const Solution two = solve(problem, options);
  EXPECT_EQ(one.cost, two.cost);
  EXPECT_EQ(one.lower_bound, two.lower_bound);
  EXPECT_EQ(one.solutions.front().arcs, two.solutions.front().arcs);
  EXPECT_EQ(one.multipliers, two.multipliers);
}

TEST(ManyToOneOnce, BoundsOfOneAreNone) {
  ProblemBuilder builder({2, 2});
  for (Index i = 1; i <= 2; ++i) {
    for (Index j = 1; j <= 2; ++j) builder.add_arc({i, j}, -1.0 * i * j);
    builder.set_use_bounds(0, i, {1, 1});
    builder.set_use_bounds(1, i, {1, 1});
  }
  const Problem problem = std::move(builder).build();
  EXPECT_FALSE(problem.is_many_to_one());
  EXPECT_EQ(solve(problem).cost, -5);
}

// 20 singletons of 1e308: no solution can be named, and none is claimed.
TEST(ManyToOneOnce, NamesNoSolutionWhoseCostOverflows) {
  for (const double cost : {1e308, -1e308}) {
    ProblemBuilder builder({2, 2});
    builder.add_arc({1, 1}, -3);
    builder.add_arc({1, 0}, cost);
    builder.set_use_bounds(0, 1, {20, 20});
    const Problem problem = std::move(builder).build();
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kPrecisionLost);
    EXPECT_TRUE(solution.solutions.empty());
    EXPECT_EQ(solution.cost, kInfinity);
    EXPECT_TRUE(check(problem, solution).faults.empty());
  }
}

}  // namespace
}  // namespace nda
