#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stop_token>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "cost_checks.hpp"
#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/random_problems.hpp"

namespace nda {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;

static_assert(!std::is_constructible_v<Ranking, Problem>, "the problem must outlive it");
static_assert(!std::is_copy_constructible_v<Ranking>);

// What next() gave, held against what all of it must be.
class Given {
 public:
  void add(const RankedSolution& next) {
    EXPECT_EQ(next.rank, static_cast<int>(costs.size()) + 1);
    EXPECT_TRUE(different_.insert(next.arcs).second) << "rank " << next.rank;
    EXPECT_TRUE(next.proven) << "rank " << next.rank;
    costs.push_back(next.cost);
  }

  std::vector<double> costs;

 private:
  std::set<std::vector<std::vector<Index>>> different_;
};

Problem square(std::uint64_t seed) {
  support::RandomProblemOptions options;
  options.sizes = {8, 8, 8};
  options.num_arcs = 300;
  return support::random_problem(seed, options);
}

TEST(Ranking, GivesAllSolutionsAsBruteForceDoes) {
  int ranked = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const std::optional<std::vector<double>> all = all_costs(random.problem);
    if (!all) continue;
    Ranking ranking(random.problem);
    Given given;
    RankedSolution next;
    while (ranking.next(next) && next.proven) given.add(next);
    if (ranking.status() == Status::kPrecisionLost) continue;
    EXPECT_EQ(ranking.status(), all->empty() ? Status::kInfeasible : Status::kOptimal);
    EXPECT_FALSE(ranking.next(next));
    expect_costs(random.problem, *all, all->size(), given.costs);
    ++ranked;
    if (HasFatalFailure() || HasNonfatalFailure()) break;
  }
  EXPECT_GT(ranked, 2000);
}

TEST(Ranking, GivesWhatTheListHas) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = square(seed);
    const Solution list = solve_k_best(problem, 300);
    ASSERT_EQ(num_proven(list), 300u);
    Ranking ranking(problem);
    Given given;
    RankedSolution next;
    for (std::size_t r = 0; r < 300; ++r) {
      ASSERT_TRUE(ranking.next(next));
      given.add(next);
      EXPECT_NEAR(next.cost, list.solutions[r].cost, 1e-9);
    }
    Solution solution = ranking.solution();
    EXPECT_TRUE(solution.proven);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

// Calls drawn at random, with limits that strike and such that do not, moves in between: what is
// given is the sequence all the same.
TEST(Ranking, GoesOnWhereLimitsStoppedIt) {
  int struck = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const std::optional<std::vector<double>> all = all_costs(random.problem);
    if (!all) continue;
    core::Random draw(seed);
    std::stop_source stopped;
    stopped.request_stop();
    Ranking ranking(random.problem);
    Given given;
    for (bool is_done = false; !is_done;) {
      Options options;
      const std::uint64_t kind = draw.below(6);
      if (kind == 0) options.branch.max_nodes = static_cast<std::int64_t>(draw.below(30));
      if (kind == 1) options.time_limit_s = 1e-9;
      if (kind == 2) options.stop = stopped.get_token();
      if (kind == 3) ranking = Ranking(std::move(ranking));
      if (kind == 4) {
        for (const RankedSolution& guess : ranking.at_hand(draw.below(4))) {
          EXPECT_FALSE(guess.proven);
          EXPECT_GE(guess.rank, static_cast<int>(given.costs.size()) + 1);
        }
      }
      RankedSolution next;
      next.rank = -1;
      if (ranking.next(next, options)) {
        if (!next.proven) break;  // precision_lost
        given.add(next);
        continue;
      }
      EXPECT_EQ(next.rank, -1);
      is_done = ranking.status() == Status::kOptimal || ranking.status() == Status::kInfeasible;
      struck += is_done ? 0 : 1;
    }
    if (ranking.status() == Status::kPrecisionLost) continue;
    expect_costs(random.problem, *all, all->size(), given.costs);
    if (HasFatalFailure() || HasNonfatalFailure()) break;
  }
  EXPECT_GT(struck, 1000);
}

// As many nodes at a time as let nothing be listed but slowly.
TEST(Ranking, GetsOnWithFewNodesAtATime) {
  const Problem problem = square(4);
  const Solution list = solve_k_best(problem, 60);
  Ranking ranking(problem);
  RankedSolution next;
  ASSERT_TRUE(ranking.next(next));
  Options few;
  for (std::size_t r = 1; r < 60;) {
    if (ranking.next(next, few)) {
      EXPECT_TRUE(next.proven);
      EXPECT_NEAR(next.cost, list.solutions[r++].cost, 1e-9);
      few.branch.max_nodes = 1;
    } else {
      EXPECT_EQ(ranking.status(), Status::kNodeLimit);
      few.branch.max_nodes *= 2;
    }
  }
}

TEST(Ranking, SearchesNothingTwice) {
  const Problem problem = square(5);
  Ranking ranking(problem);
  RankedSolution next;
  for (int r = 0; r < 400; ++r) ASSERT_TRUE(ranking.next(next));
  const Solution list = solve_k_best(problem, 400);
  EXPECT_LT(ranking.solution().stats.nodes, 4 * list.stats.nodes);
  Options none;
  none.branch.max_nodes = 0;
  const std::int64_t nodes = ranking.solution().stats.nodes;
  while (ranking.next(next, none)) {
  }
  EXPECT_EQ(ranking.solution().stats.nodes, nodes);
  EXPECT_GT(next.rank, 400);
}

// What a gap leaves unproven stays so; the neighbours follow, of which the list sorts in those that
// are better.
TEST(Ranking, GivesTheBestOnesAtHandWhereAGapIsAllowed) {
  int num_open = 0;
  Options options;
  options.relative_gap = 0.9;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = square(seed);
    const Solution list = solve_k_best(problem, 12, options);
    if (list.proven) continue;
    ++num_open;
    Ranking ranking(problem, options);
    RankedSolution next;
    std::vector<double> costs;
    for (int rank = 1; rank <= 12; ++rank) {
      ASSERT_TRUE(ranking.next(next));
      EXPECT_FALSE(next.proven);
      EXPECT_EQ(next.rank, rank);
      costs.push_back(next.cost);
    }
    std::sort(costs.begin(), costs.end());
    ASSERT_EQ(list.solutions.size(), costs.size());
    for (std::size_t r = 0; r < costs.size(); ++r)
      EXPECT_NEAR(costs[r], list.solutions[r].cost, 1e-9);
    EXPECT_EQ(ranking.status(), Status::kGapReached);
  }
  EXPECT_GT(num_open, 3);
}

TEST(Ranking, HasSomethingAtHandWhereALimitStruck) {
  const Problem problem = square(6);
  std::stop_source source;
  source.request_stop();
  Options options;
  options.stop = source.get_token();
  Ranking ranking(problem, options);
  RankedSolution next;
  EXPECT_THAT(ranking.at_hand(5), IsEmpty());
  EXPECT_FALSE(ranking.next(next));
  EXPECT_EQ(ranking.status(), Status::kInterrupted);
  const std::vector<RankedSolution> guesses = ranking.at_hand(5);
  ASSERT_EQ(guesses.size(), 5u);
  EXPECT_EQ(guesses.front().cost, ranking.solution().cost);
  ASSERT_TRUE(ranking.next(next, {}));
  EXPECT_EQ(next.rank, 1);
  EXPECT_TRUE(next.proven);
  EXPECT_LE(next.cost, guesses.front().cost);
}

TEST(Ranking, IsOfNoUseOnceMovedFrom) {
  const Problem problem = square(7);
  Ranking ranking(problem);
  RankedSolution next;
  ASSERT_TRUE(ranking.next(next));
  Ranking other = std::move(ranking);
  EXPECT_FALSE(ranking.next(next));  // NOLINT(bugprone-use-after-move)
  EXPECT_THAT(ranking.at_hand(3), IsEmpty());
  EXPECT_THAT(ranking.solution().solutions, IsEmpty());
  ASSERT_TRUE(other.next(next));
  EXPECT_EQ(next.rank, 2);
}

TEST(Ranking, RefusesWhatSolvingRefuses) {
  Options options;
  options.time_limit_s = 0;
  const Problem problem = square(8);
  EXPECT_THROW(Ranking(problem, options), InputError);
  Ranking ranking(problem);
  RankedSolution next;
  EXPECT_THROW(ranking.next(next, options), InputError);
  ASSERT_TRUE(ranking.next(next));
  EXPECT_EQ(next.rank, 1);
}

}  // namespace
}  // namespace nda
