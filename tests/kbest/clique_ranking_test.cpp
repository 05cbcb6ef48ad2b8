#include "kbest/clique_ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "support/slack_problems.hpp"

namespace nda::kbest {
namespace {

// Rows that arcs share at random; prices and reduced costs whole or not, some arcs dearer than all
// their rows.
bnb::SlackProblem random_problem(core::Random& random, bool is_whole) {
  const auto number = [&](double most) {
    return is_whole ? static_cast<double>(random.below(static_cast<std::uint64_t>(most)))
                    : random.uniform(0, most);
  };
  const auto num_rows = 2 + static_cast<std::uint32_t>(random.below(8));
  bnb::SlackProblem problem(num_rows);
  for (std::uint32_t row = 0; row < num_rows; ++row) problem.add_row(number(6));
  const auto num_arcs = static_cast<std::uint32_t>(random.below(14));
  for (std::uint32_t a = 0; a < num_arcs; ++a) {
    std::vector<bnb::RowUse> uses;
    for (std::uint32_t row = 0; row < num_rows; ++row) {
      if (random.below(3) == 0) uses.push_back({row, 1});
    }
    if (uses.empty()) uses.push_back({0, 1});
    problem.add_arc(number(10), uses);
  }
  return problem;
}

TEST(RankCliques, AgreesWithBruteForce) {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const bool is_whole = seed % 2 == 0;
    const bnb::SlackProblem problem = random_problem(random, is_whole);
    ASSERT_TRUE(may_rank_cliques(problem));
    const std::vector<double> all = support::all_slacks(problem);
    std::vector<std::uint32_t> names(problem.num_arcs());
    std::iota(names.begin(), names.end(), 0u);
    for (const double budget : {3.5, 12.5, 1e3}) {
      for (const std::size_t k : {1, 5, 20000}) {
        Combinations combinations;
        const SlackRanking found =
            rank_cliques(problem, budget, k, is_whole ? 1 : 0, {}, names, combinations);
        ASSERT_TRUE(found.complete);
        const auto within = static_cast<std::size_t>(
            std::lower_bound(all.begin(), all.end(), budget) - all.begin());
        ASSERT_EQ(found.packings.size(), std::min(k, within));
        std::set<std::vector<std::uint32_t>> different;
        for (std::size_t r = 0; r < found.packings.size(); ++r) {
          std::vector<std::uint32_t> arcs = combinations.arcs(found.packings[r].arcs);
          std::sort(arcs.begin(), arcs.end());
          ASSERT_NEAR(found.packings[r].slack, all[r], 1e-9);
          ASSERT_NEAR(support::slack_of(problem, arcs), all[r], 1e-9);
          ASSERT_TRUE(different.insert(arcs).second);
        }
        const double next = found.packings.size() == k ? all[k - 1] : budget;
        ASSERT_NEAR(found.next, next, 1e-9);
      }
    }
  }
}

TEST(RankCliques, IsNotForWhatMustBeUsedNorForCuts) {
  bnb::SlackProblem must(1);
  must.add_row(kInfinity);
  EXPECT_FALSE(may_rank_cliques(must));
  bnb::SlackProblem cut(1);
  cut.add_row(1);
  cut.add_row(1);
  EXPECT_FALSE(may_rank_cliques(cut));
}

TEST(RankCliques, SaysWhereALimitStoppedIt) {
  core::Random random(5);
  const bnb::SlackProblem problem = random_problem(random, true);
  std::vector<std::uint32_t> names(problem.num_arcs());
  bnb::SlackLimits limits;
  limits.max_nodes = 0;
  Combinations combinations;
  EXPECT_FALSE(rank_cliques(problem, 1e3, 5, 1, limits, names, combinations).complete);
}

}  // namespace
}  // namespace nda::kbest
