#include "kbest/slack_ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "support/slack_problems.hpp"

namespace nda::kbest {
namespace {

std::vector<std::uint32_t> numbers(const bnb::SlackProblem& problem) {
  std::vector<std::uint32_t> names(problem.num_arcs());
  std::iota(names.begin(), names.end(), 0u);
  return names;
}

// Against all sets of arcs, with cuts, rows of price 0 and rows that must be used up.
TEST(RankSlack, AgreesWithBruteForce) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const bnb::SlackProblem problem = support::random_slack_problem(random);
    const std::vector<double> all = support::all_slacks(problem);
    for (const double budget : {2.6, 9.1, 1e3}) {
      for (const std::size_t k : {1, 5, 20000}) {
        Combinations combinations;
        const SlackRanking found =
            rank_slack(problem, budget, k, {}, numbers(problem), combinations);
        ASSERT_TRUE(found.complete);
        const auto within = static_cast<std::size_t>(
            std::lower_bound(all.begin(), all.end(), budget) - all.begin());
        ASSERT_EQ(found.packings.size(), std::min(k, within));
        if (within < all.size() && found.packings.size() < k) {
          ASSERT_GE(found.next, budget);
          ASSERT_LE(found.next, all[within] + 1e-9);
        } else if (found.packings.size() < k) {
          ASSERT_EQ(all.size(), within);
        }
        std::set<std::vector<std::uint32_t>> different;
        for (std::size_t r = 0; r < found.packings.size(); ++r) {
          std::vector<std::uint32_t> arcs = combinations.arcs(found.packings[r].arcs);
          std::sort(arcs.begin(), arcs.end());
          ASSERT_NEAR(found.packings[r].slack, all[r], 1e-9);
          ASSERT_NEAR(support::slack_of(problem, arcs), all[r], 1e-9);
          ASSERT_TRUE(different.insert(arcs).second);
        }
      }
    }
  }
}

TEST(RankSlack, SaysWhereALimitStoppedIt) {
  core::Random random(3);
  const bnb::SlackProblem problem = support::random_slack_problem(random);
  bnb::SlackLimits limits;
  limits.max_nodes = 0;
  Combinations combinations;
  EXPECT_FALSE(rank_slack(problem, 1e3, 5, limits, numbers(problem), combinations).complete);
}

}  // namespace
}  // namespace nda::kbest
