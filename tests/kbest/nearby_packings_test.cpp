#include "kbest/nearby_packings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.hpp"

namespace nda::kbest {
namespace {

// A cycle of rows, an arc for each two neighbours and for each row alone, at random cost.
bnb::SlackProblem cycle(std::uint64_t seed, std::uint32_t rows) {
  core::Random random(seed);
  bnb::SlackProblem problem(rows);
  for (std::uint32_t row = 0; row < rows; ++row) problem.add_row(random.uniform(0, 3));
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::vector<bnb::RowUse> one = {{row, 1}};
    const std::vector<bnb::RowUse> two = {{row, 1}, {(row + 1) % rows, 1}};
    problem.add_arc(random.uniform(0, 2), one);
    problem.add_arc(random.uniform(0, 2), two);
  }
  return problem;
}

// From nothing at all it finds packings, each with the slack it says, no two the same.
TEST(NearbyPackings, FindsWhatIsThere) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const bnb::SlackProblem problem = cycle(seed, 12);
    PackingBuffer known(20);
    known.add({{}, slack_of_packing(problem, {})});
    bnb::SlackLimits limits;
    limits.max_work = 1e5;
    EXPECT_GT(NearbyPackings(problem).search(known, kInfinity, 0, limits), 0);
    const std::vector<core::Packing> packings = known.take();
    ASSERT_EQ(packings.size(), 20u);
    for (const core::Packing& packing : packings) {
      EXPECT_DOUBLE_EQ(packing.cost, slack_of_packing(problem, packing.arcs));
      std::vector<int> used(problem.num_rows(), 0);
      for (const core::ArcId a : packing.arcs) {
        for (const bnb::RowUse use : problem.uses(a)) EXPECT_EQ(used[use.row]++, 0);
      }
    }
    const auto same = [](const core::Packing& a, const core::Packing& b) {
      return a.arcs == b.arcs;
    };
    EXPECT_EQ(std::ranges::adjacent_find(packings, same), packings.end());
  }
}

TEST(NearbyPackings, FindsNothingBeyondTheBudget) {
  const bnb::SlackProblem problem = cycle(1, 12);
  PackingBuffer known(50);
  known.add({{}, slack_of_packing(problem, {})});
  bnb::SlackLimits limits;
  limits.max_work = 1e5;
  const double budget = known.packings().front().cost / 2;
  NearbyPackings(problem).search(known, budget, 0, limits);
  EXPECT_GT(known.packings().size(), 1u);
  EXPECT_LT(known.packings()[known.packings().size() - 2].cost, budget);
}

TEST(NearbyPackings, StopsAtItsGoal) {
  const bnb::SlackProblem problem = cycle(2, 12);
  PackingBuffer known(1);
  known.add({{}, slack_of_packing(problem, {})});
  EXPECT_EQ(NearbyPackings(problem).search(known, kInfinity, known.cutoff(), {}), 0);
}

}  // namespace
}  // namespace nda::kbest
