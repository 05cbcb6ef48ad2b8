#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/random.hpp"
#include "nda/assign2d.hpp"
#include "nda/assign2d_k_best.hpp"

namespace nda {
namespace {

// 300 x 300, pairs present with probability `share`; everybody may stay out.  The costs i j (Machol
// and Wien) make all want the same.
struct Market {
  explicit Market(double share) {
    core::Random random(7);
    for (std::uint32_t i = 0; i < kSize; ++i) {
      for (std::uint32_t j = 0; j < kSize; ++j) {
        if (random.uniform() >= share) continue;
        column.push_back(j);
        cost.push_back(static_cast<double>((i + 1) * (j + 1)));
      }
      row_start.push_back(static_cast<std::uint32_t>(column.size()));
    }
  }

  static constexpr std::uint32_t kSize = 1000;
  std::vector<std::uint32_t> row_start = {0};
  std::vector<std::uint32_t> column;
  std::vector<double> cost;
  std::vector<double> outside = std::vector<double>(kSize, 1e6);

  Assign2dProblem view() const { return {row_start, column, cost, outside, outside}; }
};

TEST(SetStop, GivesUpAndLeavesTheSolverAndTheResultUsable) {
  for (const Assign2dMethod method : {Assign2dMethod::kShortestPath, Assign2dMethod::kAuction}) {
    for (const double share : {0.2, 1.0}) {
      const Market market(share);
      const double optimum = assign2d(market.view(), method).cost;
      const auto solver = make_assign2d_solver(method);
      Assign2dResult result;
      const std::function<bool()> stop = [] { return true; };
      solver->set_stop(&stop);
      EXPECT_THROW(solver->solve(market.view(), result), Assign2dInterrupted);
      ASSERT_EQ(result.column_of_row.size(), Market::kSize);
      for (const double dual : result.u) EXPECT_TRUE(std::isfinite(dual));
      for (const double dual : result.v) EXPECT_TRUE(std::isfinite(dual));
      for (std::uint32_t i = 0; i < Market::kSize; ++i) {
        const std::int32_t j = result.column_of_row[i];
        if (j != kUnassigned) {
          EXPECT_EQ(result.row_of_column[j], static_cast<std::int32_t>(i));
        }
      }
      solver->set_stop(nullptr);
      solver->solve_warm(market.view(), result);
      EXPECT_NEAR(result.cost, optimum, 1e-6);
    }
  }
}

// Every interruption is followed by another call, which goes on.
TEST(SetStop, LosesNothingOfARanking) {
  constexpr std::size_t kRanks = 400;
  const Market market(0.1);
  std::vector<double> costs;
  Assign2dRanking whole(market.view());
  for (Assign2dResult result; costs.size() < kRanks && whole.next(result);)
    costs.push_back(result.cost);
  ASSERT_EQ(costs.size(), kRanks);

  int asked = 0;
  const std::function<bool()> stop = [&] { return asked++ % 2 == 0; };
  Assign2dRanking ranking(market.view());
  Assign2dResult result;
  ASSERT_TRUE(ranking.next(result));
  ranking.set_stop(&stop);
  int interruptions = 0;
  for (std::size_t r = 1; r < kRanks;) {
    try {
      ASSERT_TRUE(ranking.next(result));
      EXPECT_EQ(result.cost, costs[r++]);
    } catch (const Assign2dInterrupted&) {
      EXPECT_EQ(result.cost, costs[r - 1]);
      ++interruptions;
    }
  }
  EXPECT_GT(interruptions, 0);
}

TEST(SetStop, ReachesTheFirstSolveOfARanking) {
  const Market market(0.1);
  const std::function<bool()> stop = [] { return true; };
  Assign2dRanking ranking(market.view());
  ranking.set_stop(&stop);
  Assign2dResult result;
  EXPECT_THROW(ranking.next(result), Assign2dInterrupted);
  ranking.set_stop(nullptr);
  ASSERT_TRUE(ranking.next(result));
  EXPECT_NEAR(result.cost, assign2d(market.view()).cost, 1e-6);
}

TEST(SetStop, ThatSaysGoOnChangesNothing) {
  const Market market(0.2);
  for (const Assign2dMethod method :
       {Assign2dMethod::kShortestPath, Assign2dMethod::kAuction, Assign2dMethod::kNetworkSimplex}) {
    const auto solver = make_assign2d_solver(method);
    Assign2dResult result;
    const std::function<bool()> stop = [] { return false; };
    solver->set_stop(&stop);
    solver->solve(market.view(), result);
    EXPECT_EQ(result.column_of_row, assign2d(market.view(), method).column_of_row);
  }
}

}  // namespace
}  // namespace nda
