#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include "cost_checks.hpp"
#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/many_to_one_problems.hpp"
#include "support/merged_tracks.hpp"

// The k best with bounds on uses.

namespace nda {
namespace {

using support::BoundedKind;
using ::testing::DoubleNear;
using ::testing::Pointwise;

constexpr double kTie = 1e-8;

// Of all choices that are solutions, ascending.
std::vector<double> costs_of_all_choices(const Problem& problem) {
  std::vector<double> costs;
  std::vector<std::size_t> arcs;
  for (std::uint64_t subset = 0; subset < std::uint64_t{1} << problem.num_arcs(); ++subset) {
    arcs.clear();
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      if ((subset >> a & 1) != 0) arcs.push_back(a);
    }
    if (const auto cost = support::cost_of_choice(problem, arcs))
      costs.push_back(static_cast<double>(*cost));
  }
  std::sort(costs.begin(), costs.end());
  return costs;
}

Problem small_problem(std::uint64_t seed) {
  BoundedKind kind;
  kind.dimensions = 2 + static_cast<int>(seed % 4);
  kind.num_arcs = 5 + static_cast<int>(seed % 6);
  kind.tight = seed % 5 < 2;
  kind.integer = seed % 2 == 0;
  kind.forbidding = seed % 3 == 0;
  return support::random_bounded_problem(seed, kind);
}

TEST(BoundedKBest, AgreesWithAllSubsets) {
  int ranked = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = small_problem(seed);
    const std::vector<double> all = costs_of_all_choices(problem);
    if (all.empty()) {
      EXPECT_EQ(solve_k_best(problem, 3).status, Status::kInfeasible);
      continue;
    }
    for (const std::size_t k : {std::size_t{2}, std::size_t{7}, all.size() + 1}) {
      const Solution solution = solve_k_best(problem, k);
      expect_sound(problem, solution);
      const std::vector<double> least(
          all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size())));
      EXPECT_THAT(costs_of(solution.solutions), Pointwise(DoubleNear(kTie), least));
      EXPECT_EQ(num_proven(solution), solution.solutions.size());
      EXPECT_TRUE(!solution.lists_all || solution.solutions.size() == all.size());
      EXPECT_TRUE(solution.lists_all || k <= all.size());
      ++ranked;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(ranked, 2000);
}

// More than any number of passes could plan for.
TEST(BoundedKBest, ListsAllWhereTheLargestNumberIsAskedFor) {
  const std::size_t largest = std::numeric_limits<std::size_t>::max();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = small_problem(seed);
    const std::vector<double> all = costs_of_all_choices(problem);
    if (all.empty()) continue;
    for (std::size_t below = 0; below < 5; ++below) {
      const Solution solution = solve_k_best(problem, largest - below);
      EXPECT_TRUE(solution.lists_all);
      EXPECT_THAT(costs_of(solution.solutions), Pointwise(DoubleNear(kTie), all));
    }
  }
}

// One after the other, to the last.
TEST(BoundedKBest, HandsOutOneAfterTheOther) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = small_problem(seed);
    const std::vector<double> all = costs_of_all_choices(problem);
    Ranking ranking(problem);
    std::vector<RankedSolution> given;
    for (RankedSolution next; ranking.next(next);) given.push_back(next);
    EXPECT_THAT(costs_of(given), Pointwise(DoubleNear(kTie), all));
    EXPECT_EQ(ranking.status(), all.empty() ? Status::kInfeasible : Status::kOptimal);
    std::set<std::vector<std::vector<Index>>> different;
    for (const RankedSolution& one : given) {
      EXPECT_TRUE(one.proven);
      EXPECT_TRUE(different.insert(one.arcs).second);
    }
    if (HasFailure()) return;
  }
}

// Whatever is called proven is, wherever nodes run out; the others are solutions.
TEST(BoundedKBest, ProvesNothingWrongAtALimitOfNodes) {
  int unproven = 0;
  int proven_at_limits = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = small_problem(seed);
    const std::vector<double> all = costs_of_all_choices(problem);
    if (all.empty()) continue;
    for (const std::int64_t nodes : {0, 1, 3, 10}) {
      Options options;
      options.branch.max_nodes = nodes;
      const Solution solution = solve_k_best(problem, 8, options);
      expect_sound(problem, solution);
      const std::size_t proven = num_proven(solution);
      for (std::size_t r = 0; r < solution.solutions.size(); ++r) {
        ASSERT_LT(r, all.size());
        if (r < proven) {
          EXPECT_NEAR(solution.solutions[r].cost, all[r], kTie);
        }
        EXPECT_GE(solution.solutions[r].cost, all[r] - kTie);
      }
      const bool is_cut_short = proven < std::min<std::size_t>(8, all.size());
      unproven += is_cut_short ? 1 : 0;
      proven_at_limits += is_cut_short && proven > 1 ? 1 : 0;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(unproven, 50);
  EXPECT_GT(proven_at_limits, 10);
}

// Lists are made in passes, for 20, 80 and 320: the nodes of the 20 best are enough for the first,
// however many those of 320 are.
TEST(BoundedKBest, KeepsWhatTheLastWholePassProved) {
  support::MergedTracksOptions tracks;
  tracks.tracks = 12;
  const Problem problem = support::MergedTracks(tracks).make();
  ASSERT_TRUE(problem.is_many_to_one());
  const Solution twenty = solve_k_best(problem, 20);
  ASSERT_EQ(num_proven(twenty), 20u);
  Options options;
  options.branch.max_nodes = twenty.stats.nodes + 1;
  const Solution many = solve_k_best(problem, 320, options);
  expect_sound(problem, many);
  EXPECT_GE(num_proven(many), 20u);
  EXPECT_LT(num_proven(many), 320u);
  std::vector<double> first = costs_of(many.solutions);
  first.resize(20);
  EXPECT_THAT(costs_of(twenty.solutions), Pointwise(DoubleNear(kTie), first));
}

TEST(BoundedKBest, KeepsItsDeadline) {
  support::MergedTracksOptions tracks;
  tracks.tracks = 60;
  const Problem problem = support::MergedTracks(tracks).make();
  for (const double seconds : {1e-4, 0.01, 0.1}) {
    Options options;
    options.time_limit_s = seconds;
    const Solution solution = solve_k_best(problem, 50, options);
    expect_sound(problem, solution);
    EXPECT_TRUE(std::is_sorted(solution.solutions.begin(),
                               solution.solutions.end(),
                               [](const auto& a, const auto& b) { return a.cost < b.cost; }));
  }
}

// Twenty of tracks that merge: those of ten are their first half, and forbidding the arcs of the
// best that the second lacks makes the second the best.
TEST(BoundedKBest, OfTracksFollowOneAnother) {
  support::MergedTracksOptions tracks;
  tracks.tracks = 30;
  const Problem problem = support::MergedTracks(tracks).make();
  const Solution twenty = solve_k_best(problem, 20);
  expect_sound(problem, twenty);
  ASSERT_EQ(twenty.solutions.size(), 20u);
  EXPECT_EQ(num_proven(twenty), 20u);
  EXPECT_NEAR(twenty.cost, solve(problem).cost, kTie);
  const std::vector<double> ten = costs_of(solve_k_best(problem, 10).solutions);
  std::vector<double> first = costs_of(twenty.solutions);
  first.resize(10);
  EXPECT_THAT(ten, Pointwise(DoubleNear(kTie), first));
}

}  // namespace
}  // namespace nda
