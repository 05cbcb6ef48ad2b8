#include "kbest/part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "core/component.hpp"
#include "cost_checks.hpp"
#include "kbest/slack_view.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "support/random_problems.hpp"

namespace nda::kbest {
namespace {

// All of a problem as one part.
Part whole(const Problem& problem, const SlackView& view, const PartPatience& patience) {
  std::vector<core::ArcId> arcs(problem.num_arcs());
  std::iota(arcs.begin(), arcs.end(), 0u);
  return Part(core::Cutter().cut(problem, view.multipliers(), arcs),
              view,
              core::find_grid(problem).step,
              patience);
}

// No trial; little patience with anything, so that every way has its turn; or as much as it takes
// with the first.
constexpr int kNever = 1000;
constexpr PartPatience kNoTrial = {-1, 1, 0, 0, 0.25, kNever};
constexpr PartPatience kNoTrialButPatience = {-1, 1e9, 0, 0, 0.25, kNever};
// Branch and cut after others; alone; without searches that end nodes.
constexpr PartPatience kTreeInTurn = {-1, 1, 0, 0};
constexpr PartPatience kTree = {-1, 1e9, 0, 0, 0, 0};
constexpr PartPatience kBareTree = {-1, 1e9, 0, 0, 0, 0, 0};

struct Ranks {
  std::vector<double> rises;
  double reached = 0;
};

Ranks rank(const Problem& problem,
           const Solution& solution,
           double reach,
           std::size_t k,
           const PartPatience& patience) {
  const SlackView view(problem, solution, {});
  Part part = whole(problem, view, patience);
  Combinations combinations;
  std::int64_t nodes = 0;
  Ranks ranks;
  // By and by: what is known of fewer and nearer ones stays.
  for (const std::size_t some : {std::min<std::size_t>(k, 2), k}) {
    EXPECT_TRUE(part.rank(some < k ? reach / 2 : reach, some, {}, combinations, nodes));
  }
  std::set<std::vector<core::ArcId>> different;
  for (const Ranked& ranked : part.list()) {
    std::vector<core::ArcId> arcs = combinations.arcs(ranked.arcs);
    std::sort(arcs.begin(), arcs.end());
    const RankedSolution found = view.solution_of(arcs);
    EXPECT_NEAR(found.cost - solution.cost, ranked.slack, 1e-9 + cost_tolerance(problem));
    EXPECT_TRUE(different.insert(std::move(arcs)).second);
    ranks.rises.push_back(ranked.slack);
  }
  ranks.reached = part.reached();
  return ranks;
}

// Those of `all` costs that are listed are the first; as many as wanted, or all within reach, are.
void expect_ranked(const std::vector<double>& all,
                   double reach,
                   std::size_t k,
                   double tolerance,
                   const Ranks& ranks) {
  ASSERT_LE(ranks.rises.size(), all.size());
  for (std::size_t r = 0; r < ranks.rises.size(); ++r)
    ASSERT_NEAR(ranks.rises[r], all[r] - all[0], tolerance);
  const std::size_t listed = ranks.rises.size();
  if (listed >= k || listed == all.size()) return;
  EXPECT_GT(all[listed] - all[0], reach - tolerance);
  EXPECT_GE(all[listed] - all[0], ranks.reached - tolerance);
}

TEST(Part, AgreesWithBruteForceWhateverItTries) {
  int ranked = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const std::optional<std::vector<double>> all = all_costs(random.problem);
    if (!all || all->empty() || random.problem.num_arcs() == 0) continue;
    const Solution solution = solve(random.problem);
    if (!solution.proven) continue;
    for (const std::size_t k : {std::size_t{3}, std::size_t{10}, all->size() + 1}) {
      const double reach = all->at(std::min(2 * k, all->size()) - 1) - all->front();
      for (const PartPatience& patience :
           {PartPatience{}, kNoTrial, kNoTrialButPatience, kTreeInTurn, kTree, kBareTree}) {
        const bool is_tree = patience.trial < 0 && patience.turns < kNever;
        if (is_tree && (seed % 30 != 0 || all->size() > 60)) continue;  // they take their time
        const Ranks ranks = rank(random.problem, solution, reach, k, patience);
        expect_ranked(*all, reach, k, 1e-9 + cost_tolerance(random.problem), ranks);
        ++ranked;
      }
    }
    if (HasFatalFailure() || HasNonfatalFailure()) break;
  }
  EXPECT_GT(ranked, 10000);
}

// Many more solutions than are wanted, the multipliers leave a gap, nothing may be left alone: what
// different ways of searching agree on.
TEST(Part, FindsTheSameInEveryWay) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Map3Options map3;
    map3.size = 10;
    map3.seed = seed;
    const Problem problem = generate_map3(map3).problem;
    const Solution solution = solve(problem);
    ASSERT_TRUE(solution.proven);
    const std::vector<double> usual = rank(problem, solution, 30, 40, {}).rises;
    for (const PartPatience& patience : {kNoTrial, kNoTrialButPatience, kTree}) {
      const std::vector<double> other = rank(problem, solution, 30, 40, patience).rises;
      ASSERT_EQ(other.size(), usual.size());
      for (std::size_t r = 0; r < usual.size(); ++r) EXPECT_NEAR(other[r], usual[r], 1e-6);
    }
  }
}

// Whoever asks again and again, with little time, does not run out of memory.
TEST(Part, KeepsNothingOfSearchesThatWereStopped) {
  const Problem problem = generate_map3({}).problem;
  const Solution solution = solve(problem);
  const SlackView view(problem, solution, {});
  Part part = whole(problem, view, {});
  Combinations combinations;
  bnb::SlackLimits limits;
  limits.max_nodes = 3000;
  for (int time = 0; time < 5; ++time) {
    std::int64_t nodes = 0;
    EXPECT_FALSE(part.rank(1e3, 10000, limits, combinations, nodes));
    EXPECT_GT(nodes, 1000);
    EXPECT_EQ(combinations.size(), 1u);
  }
}

TEST(Part, StopsAtItsLimits) {
  const Problem problem = generate_map3({}).problem;
  const Solution solution = solve(problem);
  const SlackView view(problem, solution, {});
  for (const PartPatience& patience : {PartPatience{}, kNoTrial, kNoTrialButPatience, kTree}) {
    Part part = whole(problem, view, patience);
    Combinations combinations;
    bnb::SlackLimits limits;
    limits.max_nodes = 3;
    std::int64_t nodes = 0;
    EXPECT_FALSE(part.rank(1e3, 1000, limits, combinations, nodes));
    EXPECT_LE(nodes, 4);
  }
}

}  // namespace
}  // namespace nda::kbest
