#include "bnb/clique_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bnb/arc_set.hpp"
#include "core/random.hpp"
#include "nda/proof.hpp"

namespace nda::bnb {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

void add_arc(CliqueProblem& problem, double gain, std::vector<std::uint32_t> rows) {
  problem.add_arc(gain, rows);
}

CliqueResult search(const CliqueProblem& problem, double target, CliqueLimits limits = {}) {
  return search_cliques(problem, target, limits);
}

// Three arcs that share indices pairwise, but no index of all: each index alone would allow half of
// each arc, 3; the best packing gains 2.
CliqueProblem triangle() {
  CliqueProblem problem;
  add_arc(problem, 2, {0, 1});
  add_arc(problem, 2, {1, 2});
  add_arc(problem, 2, {2, 0});
  return problem;
}

TEST(CliqueSearch, OfNothingGainsNothing) {
  const CliqueResult result = search({}, -1);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.most, 0);
  EXPECT_THAT(result.arcs, IsEmpty());
}

TEST(CliqueSearch, SeesThatATriangleIsOneClique) {
  const CliqueResult result = search(triangle(), 2);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.nodes, 1);
  EXPECT_EQ(result.most, 2);
  EXPECT_THAT(result.arcs, IsEmpty());
}

TEST(CliqueSearch, FindsWhatGainsMoreThanTheTarget) {
  const CliqueResult result = search(triangle(), 1.5);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.most, 2);
  EXPECT_EQ(result.arcs.size(), 1);
}

// A path of four: the outer two together gain 1 + 3, the inner ones 3 and 2.
TEST(CliqueSearch, ChoosesAlongAPath) {
  CliqueProblem problem;
  add_arc(problem, 1, {0});
  add_arc(problem, 3, {0, 1});
  add_arc(problem, 2, {1, 2});
  add_arc(problem, 3, {2});
  EXPECT_THAT(search(problem, 0).arcs, ElementsAre(1, 3));
}

// All subsets of arcs that exclude nothing and gain nothing: going through a list of them for each
// would end in no time that a test has.
TEST(CliqueRanking, ListsVeryManyOfOneGain) {
  CliqueProblem problem;
  for (std::uint32_t row = 0; row < 18; ++row) problem.add_arc(0, std::vector{row});
  const CliqueRanking ranking = rank_cliques(problem, 1 << 18, -1, 1, {});
  EXPECT_TRUE(ranking.complete);
  ASSERT_EQ(ranking.packings.size(), std::size_t{1} << 18);
  EXPECT_EQ(ranking.packings.front().gain, ranking.packings.back().gain);
}

TEST(CliqueSearch, StopsAtItsLimits) {
  CliqueLimits limits;
  limits.max_nodes = 1;
  const CliqueResult result = search(triangle(), 0, limits);
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.most, kInfinity);
  EXPECT_EQ(result.nodes, 1);
}

TEST(CliqueSearch, LeavesLargeProblemsAlone) {
  CliqueProblem problem;
  for (std::uint32_t a = 0; a <= kMostCliqueArcs; ++a) add_arc(problem, 1, {a});
  EXPECT_FALSE(search(problem, 0).complete);
  EXPECT_EQ(search(problem, 0).nodes, 0);
}

// Arcs that exclude nothing are taken one by one.
TEST(CliqueSearch, GoesNoDeeperThanItsProofMay) {
  for (const int arcs : {kMostProofSearchDepth, kMostProofSearchDepth + 10}) {
    CliqueProblem problem;
    for (int a = 0; a < arcs; ++a) add_arc(problem, 1, {static_cast<std::uint32_t>(a)});
    EXPECT_EQ(search(problem, 0).complete, arcs == kMostProofSearchDepth);
  }
}

// What is not told apart by doubles is not told apart by units either, whatever the sizes.
TEST(CliqueSearch, CountsGainsOfAllSizes) {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    SCOPED_TRACE(scale);
    CliqueProblem problem;
    add_arc(problem, 0.1 * scale, {0});
    add_arc(problem, 0.2 * scale, {1});
    add_arc(problem, 0.25 * scale, {0, 1});
    const CliqueResult result = search(problem, 0);
    EXPECT_THAT(result.arcs, ElementsAre(0, 1));
    EXPECT_NEAR(result.most / scale, 0.3, 1e-15);
  }
}

TEST(CliqueSearch, CountsTheLeastGains) {
  const double least = std::numeric_limits<double>::denorm_min();
  CliqueProblem problem;
  add_arc(problem, least, {0});
  add_arc(problem, 2 * least, {1});
  add_arc(problem, 2 * least, {0, 1});
  EXPECT_EQ(search(problem, 2 * least).most, 3 * least);
  EXPECT_THAT(search(problem, 3 * least).arcs, IsEmpty());
}

bool fits(const CliqueProblem& problem, std::uint32_t arc, std::uint32_t rows) {
  return std::ranges::none_of(problem.rows(arc),
                              [&](std::uint32_t row) { return (rows >> row & 1) != 0; });
}

double best_gain(const CliqueProblem& problem, std::uint32_t arc, std::uint32_t rows) {
  if (arc == problem.num_arcs()) return 0;
  double best = best_gain(problem, arc + 1, rows);
  if (!fits(problem, arc, rows)) return best;
  for (const std::uint32_t row : problem.rows(arc)) rows |= 1u << row;
  return std::max(best, problem.gain(arc) + best_gain(problem, arc + 1, rows));
}

CliqueProblem random_problem(core::Random& random, std::uint32_t arcs, std::uint32_t num_rows) {
  CliqueProblem problem;
  const bool whole = random.below(2) == 0;
  for (std::uint32_t a = 0; a < arcs; ++a) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < num_rows; ++row) {
      if (random.below(4) == 0) rows.push_back(row);
    }
    if (rows.empty()) rows.push_back(0);
    const double gain = random.uniform(0.5, 10.5);
    problem.add_arc(whole ? std::round(gain + 0.5) : gain, rows);
  }
  return problem;
}

TEST(CliqueSearch, GivesUpWhereItHasHardlyBegun) {
  core::Random random(3);
  const CliqueProblem problem = random_problem(random, 200, 40);
  CliqueLimits limits;
  limits.max_work = 1000;
  const CliqueResult result = search(problem, 0, limits);
  EXPECT_FALSE(result.complete);
  EXPECT_LT(result.work, 4000);
}

TEST(CliqueSearch, EqualsBruteForce) {
  core::Random random(7);
  for (int n = 0; n < 3000; ++n) {
    const CliqueProblem problem = random_problem(random,
                                                 1 + static_cast<std::uint32_t>(random.below(18)),
                                                 2 + static_cast<std::uint32_t>(random.below(12)));
    const double best = best_gain(problem, 0, 0);
    const double target = random.uniform(-1, 1.2 * best);
    const CliqueResult result = search(problem, target);
    ASSERT_TRUE(result.complete);
    ASSERT_NEAR(result.most, std::max(best, target), 1e-12);
    double gain = 0;
    std::uint32_t rows = 0;
    for (const std::uint32_t arc : result.arcs) {
      ASSERT_TRUE(fits(problem, arc, rows));
      for (const std::uint32_t row : problem.rows(arc)) rows |= 1u << row;
      gain += problem.gain(arc);
    }
    if (best > target)
      ASSERT_NEAR(gain, best, 1e-12);
    else
      ASSERT_THAT(result.arcs, IsEmpty());
  }
}

// One arc more or less than a word holds changes the type of the sets, not the result.
TEST(CliqueSearch, IsTheSameForSetsOfEverySize) {
  core::Random random(11);
  for (const std::uint32_t arcs : {64u, 65u, 128u, 129u, 256u, 257u, 512u, 513u, 1024u}) {
    const CliqueProblem problem = random_problem(random, arcs, 8);
    CliqueProblem doubled;  // each arc twice: the same best gain
    for (std::uint32_t a = 0; 2 * a + 1 < arcs; ++a) {
      for (int copy = 0; copy < 2; ++copy) doubled.add_arc(problem.gain(a), problem.rows(a));
    }
    CliqueProblem half;
    for (std::uint32_t a = 0; 2 * a + 1 < arcs; ++a) half.add_arc(problem.gain(a), problem.rows(a));
    EXPECT_NEAR(search(doubled, 0).most, search(half, 0).most, 1e-12);
  }
}

TEST(ArcSet, HoldsWhatWasInserted) {
  ArcSet<2> set;
  for (const std::uint32_t a : {3u, 63u, 64u, 127u}) set.insert(a);
  set.erase(63);
  ArcSet<2> other;
  for (const std::uint32_t a : {3u, 64u, 65u}) other.insert(a);
  EXPECT_EQ(set.count_common(other), 2);
  EXPECT_TRUE(set.contains(127));
  EXPECT_FALSE(set.contains(63));
  const auto list = [](const ArcSet<2>& items) {
    std::vector<std::uint32_t> found;
    items.for_each([&](std::uint32_t a) { found.push_back(a); });
    return found;
  };
  EXPECT_THAT(list(set), ElementsAre(3, 64, 127));
  ArcSet<2> all = set;
  EXPECT_THAT(list(all |= other), ElementsAre(3, 64, 65, 127));
  EXPECT_THAT(list(all -= other), ElementsAre(127));
  EXPECT_THAT(list(set &= other), ElementsAre(3, 64));
}

}  // namespace
}  // namespace nda::bnb
