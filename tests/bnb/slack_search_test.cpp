#include "bnb/slack_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "nda/proof.hpp"

namespace nda::bnb {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

SlackResult search(const SlackProblem& problem, double budget, double max_work = kInfinity) {
  SlackLimits limits;
  limits.max_work = max_work;
  return search_slack(problem, budget, limits);
}

void add_arc(SlackProblem& problem, double reduced, std::vector<RowUse> uses) {
  problem.add_arc(reduced, uses);
}

TEST(SlackSearch, OfNothingCostsNothing) {
  const SlackResult result = search(SlackProblem(0), 1);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.slack, 0);
}

TEST(SlackSearch, ChoosesBetweenAnArcAndLeavingItsRow) {
  for (const double price : {1.0, 3.0}) {
    SlackProblem problem(1);
    problem.add_row(price);
    add_arc(problem, 2, {{0, 1}});
    const SlackResult result = search(problem, 10);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.slack, std::min(price, 2.0));
    EXPECT_EQ(result.arcs.size(), price > 2 ? 1u : 0u);
  }
}

TEST(SlackSearch, FindsNothingWhereTheBudgetIsTooSmall) {
  SlackProblem problem(1);
  problem.add_row(3);
  add_arc(problem, 2, {{0, 1}});
  const SlackResult result = search(problem, 1.9);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.slack, kInfinity);
}

TEST(SlackSearch, UsesUpWhatMustBe) {
  SlackProblem problem(2);
  problem.add_row(kInfinity);
  problem.add_row(kInfinity);
  add_arc(problem, 5, {{0, 1}, {1, 1}});
  add_arc(problem, 1, {{0, 1}});
  EXPECT_THAT(search(problem, 10).arcs, ElementsAre(0));
  add_arc(problem, 1, {{1, 1}});
  EXPECT_THAT(search(problem, 10).arcs, UnorderedElementsAre(1, 2));
}

TEST(SlackSearch, FillsACutWithSeveralArcs) {
  // A cut of capacity 3 over indices without a price: coefficients 2 and 1 fill it.
  SlackProblem problem(3);
  for (int i = 0; i < 3; ++i) problem.add_row(0);
  problem.add_row(4, 3);
  add_arc(problem, 1, {{0, 1}, {3, 1}});
  add_arc(problem, 1, {{1, 1}, {3, 2}});
  add_arc(problem, 1, {{1, 1}, {2, 1}, {3, 2}});
  const SlackResult result = search(problem, 10);
  EXPECT_EQ(result.slack, 2);
  EXPECT_THAT(result.arcs, UnorderedElementsAre(0, 1));
}

// Weights of indices and a divisor: a cut that no choice of arcs without a common index violates.
struct RandomCut {
  std::vector<std::uint32_t> weights;
  std::uint32_t divisor;
  std::uint32_t total = 0;

  RandomCut(std::uint32_t num_indices, core::Random& random)
      : divisor(static_cast<std::uint32_t>(2 + random.below(3))) {
    for (std::uint32_t i = 0; i < num_indices; ++i) {
      weights.push_back(static_cast<std::uint32_t>(random.below(divisor)));
      total += weights.back();
    }
  }

  std::uint32_t coefficient(const std::vector<RowUse>& uses) const {
    std::uint32_t sum = 0;
    for (const RowUse use : uses) sum += use.row < weights.size() ? weights[use.row] : 0;
    return sum / divisor;
  }
};

// Any rows and arcs; prices 0 or not, some rows that must be used up, up to three cuts.
SlackProblem random_problem(core::Random& random) {
  const auto num_indices = static_cast<std::uint32_t>(2 + random.below(7));
  SlackProblem problem(num_indices);
  const auto cost = [&] {
    return random.below(3) == 0 ? 0.0 : std::ceil(random.uniform(0, 20)) / 4;
  };
  for (std::uint32_t i = 0; i < num_indices; ++i)
    problem.add_row(random.below(9) == 0 ? kInfinity : cost());
  std::vector<RandomCut> cuts;
  for (std::size_t c = random.below(4); c > 0; --c) {
    cuts.emplace_back(num_indices, random);
    problem.add_row(cost(), cuts.back().total / cuts.back().divisor);
  }
  for (std::size_t n = random.below(14); n > 0; --n) {
    std::vector<RowUse> uses;
    for (std::uint32_t row = 0; row < num_indices; ++row) {
      if (random.below(3) == 0) uses.push_back({row, 1});
    }
    if (uses.empty()) continue;
    for (std::uint32_t c = 0; c < cuts.size(); ++c) {
      const std::uint32_t coefficient = cuts[c].coefficient(uses);
      if (coefficient > 0) uses.push_back({num_indices + c, coefficient});
    }
    problem.add_arc(cost(), uses);
  }
  return problem;
}

// The slack of a set of arcs; +inf where two share an index.
double slack_of(const SlackProblem& problem, const std::vector<std::uint32_t>& arcs) {
  std::vector<std::uint32_t> filled(problem.num_rows(), 0);
  double slack = 0;
  for (const std::uint32_t a : arcs) {
    slack += problem.reduced(a);
    for (const RowUse use : problem.uses(a)) filled[use.row] += use.coefficient;
  }
  for (std::uint32_t row = 0; row < problem.num_rows(); ++row) {
    const std::uint32_t capacity = problem.capacity(row);
    if (filled[row] > capacity) return kInfinity;
    if (filled[row] < capacity) slack += (capacity - filled[row]) * problem.price(row);
  }
  return slack;
}

double least_slack(const SlackProblem& problem) {
  double least = kInfinity;
  for (std::uint32_t set = 0; set < 1u << problem.num_arcs(); ++set) {
    std::vector<std::uint32_t> arcs;
    for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
      if ((set >> a & 1) != 0) arcs.push_back(a);
    }
    const double slack = slack_of(problem, arcs);
    least = std::min(least, slack);
  }
  return least;
}

TEST(SlackSearch, AgreesWithBruteForce) {
  int num_stopped = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const SlackProblem problem = random_problem(random);
    const double least = least_slack(problem);
    for (const double budget : {kInfinity, least + 0.1, least, 2.5, 100.0}) {
      SCOPED_TRACE(budget);
      const SlackResult result = search(problem, budget);
      ASSERT_TRUE(result.complete);
      // To the tolerance of the budget, a packing of exactly the budget may turn up.
      if (least < budget) {
        ASSERT_NEAR(result.slack, least, 1e-9);
      } else {
        ASSERT_GE(result.slack, budget);
      }
      if (result.slack < kInfinity) {
        ASSERT_NEAR(slack_of(problem, result.arcs), result.slack, 1e-9);
      }
    }
    const SlackResult stopped = search(problem, kInfinity, static_cast<double>(random.below(40)));
    num_stopped += !stopped.complete;
    if (stopped.slack < kInfinity) {
      ASSERT_NEAR(slack_of(problem, stopped.arcs), stopped.slack, 1e-9);
    }
  }
  EXPECT_GT(num_stopped, 1000);
}

// So many odd cycles side by side, each with one arc too few: a product of searches without
// division.
TEST(SlackSearch, DividesWhatFallsApart) {
  constexpr std::uint32_t kCopies = 100;
  SlackProblem problem(3 * kCopies);
  for (std::uint32_t row = 0; row < 3 * kCopies; ++row) problem.add_row(0.5);
  for (std::uint32_t c = 0; c < kCopies; ++c) {
    for (std::uint32_t i = 0; i < 3; ++i)
      add_arc(problem, 0, {{3 * c + i, 1}, {3 * c + (i + 1) % 3, 1}});
  }
  const SlackResult result = search(problem, kInfinity);
  EXPECT_TRUE(result.complete);
  EXPECT_NEAR(result.slack, 0.5 * kCopies, 1e-9);
  EXPECT_LT(result.nodes, 20 * kCopies);
}

// A ladder of arcs (i, i) and (i, i + 1): a branching on every rung.
TEST(SlackSearch, GoesNoDeeperThanItsProofMay) {
  for (const bool deep : {false, true}) {
    const auto length = static_cast<std::uint32_t>(kMostProofSearchDepth + (deep ? 10 : -10));
    SlackProblem problem(2 * length);
    for (std::uint32_t row = 0; row < 2 * length; ++row) problem.add_row(0.5);
    for (std::uint32_t i = 0; i < length; ++i) {
      add_arc(problem, 0, {{i, 1}, {length + i, 1}});
      if (i + 1 < length) add_arc(problem, 0, {{i, 1}, {length + i + 1, 1}});
    }
    const SlackResult result = search(problem, kInfinity);
    EXPECT_EQ(result.complete, !deep);
    if (!deep) {
      EXPECT_EQ(result.slack, 0);
    }
  }
}

// All pairs of an odd number of rows: one must stay, but no row tells.
TEST(SlackSearch, StopsAtTheDeadline) {
  constexpr std::uint32_t kRows = 41;
  SlackProblem problem(kRows);
  for (std::uint32_t row = 0; row < kRows; ++row) problem.add_row(1);
  for (std::uint32_t first = 0; first < kRows; ++first) {
    for (std::uint32_t second = first + 1; second < kRows; ++second)
      add_arc(problem, 0, {{first, 1}, {second, 1}});
  }
  SlackLimits limits;
  limits.deadline = core::Deadline(0.05);
  const core::Stopwatch watch;
  const SlackResult result = search_slack(problem, kInfinity, limits);
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.slack, 1);
  EXPECT_LT(watch.seconds(), 1);
}

}  // namespace
}  // namespace nda::bnb
