#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <set>
#include <vector>

#include "cost_checks.hpp"
#include "counted_clock.hpp"
#include "kbest/part.hpp"
#include "kbest/ranker.hpp"
#include "kbest/slack_view.hpp"
#include "nda/generate.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "support/random_problems.hpp"

// What lists of thousands ask for: an end when the clock strikes, whatever is long, and an order
// among very many that cost the same.

namespace nda::kbest {
namespace {

constexpr std::int64_t kAnyNodes = std::int64_t{1} << 40;

// No index may be left alone, and there are 10! * 10! solutions, of few costs.
Problem square() {
  Map3Options map3;
  map3.size = 10;
  return generate_map3(map3).problem;
}

// Lists `planned` until the clock strikes with so many listed, then the rest.
void expect_end_with_the_clock(const Problem& problem, std::size_t planned, std::size_t at_strike) {
  SCOPED_TRACE(at_strike);
  const Solution solution = solve(problem);
  ASSERT_TRUE(solution.proven);
  const std::unique_ptr<Ranker> ranker = make_ranker(problem, solution);
  const CountedClock clock([&](int) { return ranker->listed().size() >= at_strike; });
  EXPECT_FALSE(ranker->list(planned, planned, {kAnyNodes, clock.deadline()}));
  EXPECT_EQ(ranker->listed().size(), at_strike);
  EXPECT_TRUE(ranker->list(planned, planned, {kAnyNodes, {}}));
  const std::unique_ptr<Ranker> other = make_ranker(problem, solution);
  EXPECT_TRUE(other->list(planned, planned, {kAnyNodes, {}}));
  EXPECT_EQ(costs_of(ranker->listed()), costs_of(other->listed()));
}

TEST(LongLists, EndWithTheClock) {
  for (const std::size_t at_strike : {1, 2, 700, 2999})
    expect_end_with_the_clock(square(), 3000, at_strike);
}

TEST(LongLists, EndWithTheClockWhereUsesHaveBounds) {
  BoundedOptions options;
  options.size = 6;
  options.arcs = 40;
  expect_end_with_the_clock(generate_bounded(options).problem, 500, 300);
}

// The first pass is for 10,000.
TEST(LongLists, AreLeftWithWhatAPassProved) {
  const Problem problem = square();
  const Solution solution = solve(problem);
  const std::unique_ptr<Ranker> ranker = make_ranker(problem, solution);
  const CountedClock clock([&](int) { return ranker->listed().size() == 10000; });
  EXPECT_FALSE(ranker->list(100000, 100000, {kAnyNodes, clock.deadline()}));
  ASSERT_EQ(ranker->listed().size(), 10000u);
  EXPECT_EQ(costs_of(ranker->listed()), costs_of(solve_k_best(problem, 10000).solutions));
}

TEST(LongLists, CountTheirMemory) {
  const Solution solution = solve_k_best(square(), 30000);
  std::size_t bytes = 0;
  for (const RankedSolution& ranked : solution.solutions) {
    bytes += sizeof(ranked) + ranked.arcs.size() * sizeof(ranked.arcs.front());
    for (const std::vector<Index>& arc : ranked.arcs) bytes += arc.size() * sizeof(Index);
  }
  EXPECT_GT(solution.stats.peak_memory_bytes, bytes);
}

// At any look: what is listed by then is the beginning of the list, what else is at hand is not of
// it, and the rest follows when there is time.
void expect_right_wherever_the_clock_strikes(const Problem& problem, std::size_t k, int& struck) {
  const Solution solution = solve(problem);
  if (!solution.proven) return;
  const std::vector<double> costs = costs_of(solve_k_best(problem, k).solutions);
  bool has_struck = true;
  for (int strike = 1; has_struck; strike += 1 + strike / 8) {
    SCOPED_TRACE(strike);
    const std::unique_ptr<Ranker> ranker = make_ranker(problem, solution);
    const CountedClock clock([&](int look) { return look == strike; });
    const bool is_whole = ranker->list(k, k, {kAnyNodes, clock.deadline()});
    has_struck = clock.has_struck();
    struck += !is_whole;
    ASSERT_TRUE(has_struck || is_whole);
    ASSERT_TRUE(!ranker->has_all() || ranker->listed().size() == costs.size());
    std::set<std::vector<std::vector<Index>>> different;
    for (std::size_t r = 0; r < std::min(k, ranker->listed().size()); ++r)
      ASSERT_NEAR(ranker->listed()[r].cost, costs[r], cost_tolerance(problem));
    for (const RankedSolution& ranked : ranker->listed())
      ASSERT_TRUE(different.insert(ranked.arcs).second);
    for (const RankedSolution& ranked : ranker->unlisted(0, 5, clock.deadline()))
      ASSERT_TRUE(different.insert(ranked.arcs).second);
    ASSERT_TRUE(ranker->list(k, k, {kAnyNodes, {}}));
    ASSERT_GE(ranker->listed().size(), costs.size());
    for (std::size_t r = 0; r < costs.size(); ++r)
      ASSERT_NEAR(ranker->listed()[r].cost, costs[r], cost_tolerance(problem));
  }
}

TEST(LongLists, AreRightWhereverTheClockStrikes) {
  int struck = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    expect_right_wherever_the_clock_strikes(random.problem, 40, struck);
    const support::RandomCase bounded = support::random_bounded_case(seed);
    SCOPED_TRACE(bounded.description);
    expect_right_wherever_the_clock_strikes(bounded.problem, 40, struck);
  }
  EXPECT_GT(struck, 500);
}

// A search that nodes stop has thousands to note: the clock is looked at all the while.
TEST(LongLists, AreNotedUnderTheClock) {
  const Problem problem = square();
  const Solution solution = solve(problem);
  const SlackView view(problem, solution, {});
  std::vector<core::ArcId> arcs(problem.num_arcs());
  std::iota(arcs.begin(), arcs.end(), 0u);
  const auto looks = [&](int at_strike) {
    const CountedClock clock([&](int look) { return look == at_strike; });
    Part part(core::Cutter().cut(problem, view.multipliers(), arcs), view, 1);
    Combinations combinations;
    bnb::SlackLimits limits;
    limits.max_nodes = 100000;
    limits.deadline = clock.deadline();
    std::int64_t nodes = 0;
    EXPECT_FALSE(part.rank(100, 100000, limits, combinations, nodes));
    return clock.looks();
  };
  const int all = looks(0);
  EXPECT_GT(all, 10000);
  EXPECT_LT(looks(all / 2), all / 2 + 10);
}

// Costs of few sizes, or one: for any k the costs are those of enumeration, every solution listed
// is one of those, and no two are the same.
TEST(LongLists, HaveEveryTieOnce) {
  int ties = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.num_arcs = 20;
    options.costs = seed % 2 == 0 ? support::CostKind::kFew : support::CostKind::kZero;
    options.sign = seed % 3 == 0 ? support::SignKind::kMixed : support::SignKind::kNegative;
    if (seed % 5 == 0) options.singletons = support::SingletonKind::kPriced;
    const Problem problem = support::random_problem(seed, options);
    const std::vector<support::ExactSolution> all = support::all_solutions(problem);
    std::set<std::vector<std::vector<Index>>> solutions;
    for (const support::ExactSolution& solution : all) solutions.insert(solution.arcs);
    for (const std::size_t k : {std::size_t{2}, all.size() / 3 + 1, all.size(), all.size() + 1}) {
      const Solution solution = solve_k_best(problem, k);
      expect_sound(problem, solution);
      ASSERT_EQ(solution.solutions.size(), std::min(k, all.size()));
      for (std::size_t r = 0; r < solution.solutions.size(); ++r) {
        EXPECT_EQ(solution.solutions[r].cost, all[r].cost);
        EXPECT_TRUE(solution.solutions[r].proven);
        EXPECT_EQ(solutions.count(solution.solutions[r].arcs), 1u);
        ties += r > 0 && all[r].cost == all[r - 1].cost;
      }
    }
  }
  EXPECT_GT(ties, 10000);
}

}  // namespace
}  // namespace nda::kbest
