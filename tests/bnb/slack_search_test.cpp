#include "bnb/slack_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bnb/slack_parts.hpp"
#include "core/random.hpp"
#include "nda/proof.hpp"
#include "support/no_alloc.hpp"
#include "support/other_orders.hpp"
#include "support/slack_problems.hpp"

namespace nda::bnb {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

SlackResult search(const SlackProblem& problem, double budget, double max_work = kInfinity) {
  SlackLimits limits;
  limits.max_work = max_work;
  return search_slack(problem, budget, limits);
}

// Everyone shares after every node.
constexpr SlackRounds kShareAtOnce = {0, 0};

SlackResult search_shared(const SlackProblem& problem,
                          double budget,
                          const core::ForAll& for_all = {},
                          double max_work = kInfinity,
                          const SlackRounds& rounds = kShareAtOnce) {
  SlackLimits limits;
  limits.max_work = max_work;
  limits.for_all = for_all;
  return search_slack(problem, budget, limits, rounds);
}

// Arcs between neighbours at random, cuts over three indices in a row: enough for hundreds of
// nodes.
SlackProblem tangled_problem(core::Random& random) {
  constexpr std::uint32_t kRows = 24;
  constexpr int kArcs = 70;
  SlackProblem problem(kRows);
  for (std::uint32_t row = 0; row < kRows; ++row) problem.add_row(random.uniform(0, 1));
  const auto first_of_cut = [](std::uint32_t cut) { return 3 * cut; };
  constexpr std::uint32_t kCuts = kRows / 3;
  for (std::uint32_t cut = 0; cut < kCuts; ++cut) problem.add_row(random.uniform(0, 0.5));
  for (int a = 0; a < kArcs; ++a) {
    const auto first = static_cast<std::uint32_t>(random.below(kRows));
    std::vector<RowUse> uses = {{first, 1}};
    for (const std::uint64_t step : {1 + random.below(3), 4 + random.below(3)}) {
      if (first + step < kRows) uses.push_back({static_cast<std::uint32_t>(first + step), 1});
    }
    // Of arcs with two indices or more of three, one fits.
    for (std::uint32_t cut = 0; cut < kCuts; ++cut) {
      const auto in_cut = [&](const RowUse& use) {
        return use.row < kRows && use.row - first_of_cut(cut) < 3;
      };
      if (std::count_if(uses.begin(), uses.end(), in_cut) >= 2) uses.push_back({kRows + cut, 1});
    }
    problem.add_arc(random.uniform(0, 0.6), uses);
  }
  return problem;
}

void expect_same(const SlackResult& one, const SlackResult& other) {
  EXPECT_EQ(one.slack, other.slack);
  EXPECT_EQ(one.arcs, other.arcs);
  EXPECT_EQ(one.complete, other.complete);
  EXPECT_EQ(one.nodes, other.nodes);
  EXPECT_EQ(one.work, other.work);
  EXPECT_EQ(one.fixing.dropped, other.fixing.dropped);
  EXPECT_EQ(one.fixing.taken, other.fixing.taken);
  EXPECT_EQ(one.fixing.splits, other.fixing.splits);
  EXPECT_EQ(one.fixing.parts, other.fixing.parts);
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

// Arc 0 is all that may use row 0; arc 1 shares row 1 with it, arc 2 is too dear.
TEST(SlackSearch, CountsWhatTheBudgetFixes) {
  SlackProblem problem(3);
  for (int row = 0; row < 3; ++row) problem.add_row(row == 0 ? 100 : 1);
  add_arc(problem, 0, {{0, 1}, {1, 1}});
  add_arc(problem, 0, {{1, 1}});
  add_arc(problem, 20, {{2, 1}});
  const SlackResult result = search(problem, 10);
  EXPECT_THAT(result.arcs, ElementsAre(0));
  EXPECT_EQ(result.slack, 1);
  EXPECT_EQ(result.fixing.taken, 1);
  EXPECT_EQ(result.fixing.dropped, 2);
  EXPECT_EQ(result.fixing.splits, 0);
}

// Three times two rows, an arc over both and one for each: nothing is fixed before they fall apart.
TEST(SlackSearch, CountsTheParts) {
  SlackProblem problem(6);
  for (int row = 0; row < 6; ++row) problem.add_row(1);
  for (std::uint32_t row = 0; row < 6; row += 2) {
    add_arc(problem, 0.5, {{row, 1}, {row + 1, 1}});
    add_arc(problem, 0, {{row, 1}});
    add_arc(problem, 0, {{row + 1, 1}});
  }
  const SlackResult result = search(problem, 10);
  EXPECT_EQ(result.slack, 0);
  EXPECT_EQ(result.fixing.splits, 1);
  EXPECT_EQ(result.fixing.parts, 3);
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

// find(problem, budget, most work) of random problems, with budgets around the least slack.
template <typename Search>
void agrees_with_brute_force(Search&& find) {
  int num_stopped = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const SlackProblem problem = support::random_slack_problem(random);
    const double least = support::all_slacks(problem).front();
    for (const double budget : {kInfinity, least + 0.1, least, 2.5, 100.0}) {
      SCOPED_TRACE(budget);
      const SlackResult result = find(problem, budget, kInfinity);
      ASSERT_TRUE(result.complete);
      // To the tolerance of the budget, a packing of exactly the budget may turn up.
      if (least < budget) {
        ASSERT_NEAR(result.slack, least, 1e-9);
      } else {
        ASSERT_GE(result.slack, budget);
      }
      if (result.slack < kInfinity) {
        ASSERT_NEAR(support::slack_of(problem, result.arcs), result.slack, 1e-9);
      }
    }
    const SlackResult stopped = find(problem, kInfinity, static_cast<double>(random.below(40)));
    num_stopped += !stopped.complete;
    if (stopped.slack < kInfinity) {
      ASSERT_NEAR(support::slack_of(problem, stopped.arcs), stopped.slack, 1e-9);
    }
  }
  EXPECT_GT(num_stopped, 1000);
}

TEST(SlackSearch, AgreesWithBruteForce) {
  agrees_with_brute_force([](const SlackProblem& problem, double budget, double max_work) {
    return search(problem, budget, max_work);
  });
}

TEST(SlackSearch, AgreesWithBruteForceWhenItIsShared) {
  agrees_with_brute_force([](const SlackProblem& problem, double budget, double max_work) {
    return search_shared(problem, budget, {}, max_work);
  });
}

// Costs are whole, multipliers are not: slacks that differ do so by more than 0.99.
SlackProblem whole_problem(core::Random& random) {
  constexpr std::uint32_t kRows = 18;
  SlackProblem problem(kRows);
  for (std::uint32_t row = 0; row < kRows; ++row) problem.add_row(random.uniform(0, 3));
  for (int a = 0; a < 50; ++a) {
    const auto first = static_cast<std::uint32_t>(random.below(kRows - 6));
    const auto second = static_cast<std::uint32_t>(first + 1 + random.below(3));
    const auto third = static_cast<std::uint32_t>(second + 1 + random.below(3));
    const double price = problem.price(first) + problem.price(second) + problem.price(third);
    const double cost = std::ceil(-price) + static_cast<double>(random.below(3));
    add_arc(problem, cost + price, {{first, 1}, {second, 1}, {third, 1}});
  }
  return problem;
}

TEST(SlackSearch, LosesNothingByTheStepOfAGrid) {
  core::Random random(7);
  std::int64_t nodes = 0;
  std::int64_t nodes_by_steps = 0;
  for (int n = 0; n < 2000; ++n) {
    const SlackProblem problem = whole_problem(random);
    const double budget = 1 + static_cast<double>(random.below(40));
    const SlackResult expected = search(problem, budget);
    SlackLimits limits;
    limits.step = 0.99;
    for (const SlackRounds& rounds : {SlackRounds{}, kShareAtOnce}) {
      const SlackResult result = search_slack(problem, budget, limits, rounds);
      ASSERT_TRUE(result.complete) << n;
      if (expected.slack < kInfinity) {
        ASSERT_NEAR(result.slack, expected.slack, 1e-9) << n;
      }
      ASSERT_EQ(result.slack < kInfinity, expected.slack < kInfinity) << n;
      if (rounds.first_work > 0) nodes_by_steps += result.nodes;
    }
    nodes += expected.nodes;
  }
  EXPECT_LT(static_cast<double>(nodes_by_steps), 0.9 * static_cast<double>(nodes));
}

TEST(SlackSearch, FindsTheSameAloneAndShared) {
  std::int64_t nodes = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const SlackProblem problem = tangled_problem(random);
    const SlackResult alone = search(problem, kInfinity);
    const SlackRounds rounds = {500, static_cast<double>(random.below(2000))};
    const SlackResult shared = search_shared(problem, kInfinity, {}, kInfinity, rounds);
    ASSERT_TRUE(shared.complete);
    ASSERT_NEAR(shared.slack, alone.slack, 1e-9);
    ASSERT_NEAR(support::slack_of(problem, shared.arcs), shared.slack, 1e-9);
    nodes += alone.nodes;
  }
  EXPECT_GT(nodes, 300 * 50);
}

TEST(SlackSearch, DoesTheSameHoweverItsPartsAreDone) {
  int num_stopped = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const SlackProblem problem = tangled_problem(random);
    const double max_work = seed % 2 == 0 ? kInfinity : 5000;
    const SlackRounds rounds = {200, 400};
    const SlackResult in_turn = search_shared(problem, kInfinity, {}, max_work, rounds);
    for (const core::ForAll& for_all :
         {core::ForAll(support::backwards), core::ForAll(support::at_once)})
      expect_same(in_turn, search_shared(problem, kInfinity, for_all, max_work, rounds));
    num_stopped += !in_turn.complete;
  }
  EXPECT_GT(num_stopped, 5);
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
  const SlackResult shared = search_shared(problem, kInfinity);
  EXPECT_TRUE(shared.complete);
  EXPECT_NEAR(shared.slack, result.slack, 1e-9);
  EXPECT_LT(shared.nodes, 30 * kCopies);
}

// Hundreds of choices, each of which leaves nearly all arcs: those that wait share one node.
TEST(SlackSearch, HoldsNoCopyOfTheArcsForEveryChoiceThatItGivesAway) {
  constexpr std::uint32_t kSize = 20;  // of each of three dimensions
  constexpr std::size_t kArcs = 6000;
  core::Random random(1);
  SlackProblem problem(3 * kSize);
  for (std::uint32_t row = 0; row < 3 * kSize; ++row) problem.add_row(random.uniform(0.5, 1));
  const auto index = [&](std::uint32_t k) {
    return RowUse{k * kSize + static_cast<std::uint32_t>(random.below(kSize)), 1};
  };
  for (std::size_t a = 0; a < kArcs; ++a)
    add_arc(problem, random.uniform(0, 1), {index(0), index(1), index(2)});
  const std::size_t bytes = support::most_bytes_held([&] {
    const SlackResult result = search_shared(problem, kInfinity, {}, 3e6, {0, 1e4});
    EXPECT_FALSE(result.complete);
    EXPECT_GT(result.nodes, 100);
  });
  EXPECT_LT(bytes, 100 * kArcs * sizeof(OpenArc));
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
