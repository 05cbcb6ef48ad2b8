#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "assign2d/auction.hpp"
#include "assign2d/brute_force.hpp"
#include "assign2d/certificate.hpp"
#include "assign2d/core_solver.hpp"
#include "assign2d/dense_solver.hpp"
#include "assign2d/instances.hpp"
#include "assign2d/network_simplex.hpp"
#include "assign2d/shortest_path.hpp"
#include "assign2d/sparse_solver.hpp"
#include "nda/assign2d_k_best.hpp"
#include "support/no_alloc.hpp"

// One contract, every implementation.

namespace nda {
namespace {

using support::below;
using support::from_matrix;
using support::kAbsent;
using support::OwnedProblem;
using support::Random;
using support::Recipe;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Implementation {
  const char* name;
  std::unique_ptr<Assign2dSolver> (*make)();
  bool reuses_memory;
};

template <class Solver>
std::unique_ptr<Assign2dSolver> make() {
  return std::make_unique<Solver>();
}

class Assign2dSolvers : public ::testing::TestWithParam<Implementation> {
 protected:
  Assign2dResult solve(const OwnedProblem& problem) {
    Assign2dResult result;
    solver_->solve(problem.view(), result);
    EXPECT_THAT(support::faults_of(problem.view(), result), IsEmpty());
    return result;
  }

  std::unique_ptr<Assign2dSolver> solver_ = GetParam().make();
};

void expect_optimum(const OwnedProblem& problem, const Assign2dResult& result) {
  ASSERT_THAT(support::faults_of(problem.view(), result), IsEmpty());
  const double optimum = support::brute_force_cost(problem.view());
  ASSERT_EQ(result.feasible, optimum < kInfinity);
  if (!result.feasible) return;
  const double members = problem.view().num_rows() + problem.view().num_columns();
  ASSERT_NEAR(result.cost, optimum, 1e-12 * members * support::cost_scale(problem.view()));
}

// Rows 0 and 1 want column 0; the detour over column 1 costs row 1 one more, row 0 three more.
//       1  4  -     Optimum 1 + 2 + 2 = 5 on the diagonal.
//       1  2  5     Duals u = (1, 1, 2), v = (0, 1, 0): 4 + 1 = 5.
//       3  -  2     All must be assigned.
TEST_P(Assign2dSolvers, SolveATinyPerfectAssignment) {
  const OwnedProblem problem = from_matrix({{1, 4, kAbsent}, {1, 2, 5}, {3, kAbsent, 2}},
                                           {kInfinity, kInfinity, kInfinity},
                                           {kInfinity, kInfinity, kInfinity});
  const Assign2dResult result = solve(problem);
  EXPECT_DOUBLE_EQ(result.cost, 5);
  EXPECT_THAT(result.column_of_row, ElementsAre(0, 1, 2));
}

//      -5 -4     Outside costs: rows 0, 0; columns 0, 1.
//      -6 -1     Optimum -4 - 6 = -10.  Duals u = (-5, -4), v = (-2, 1): -9 - 1 = -10.
TEST_P(Assign2dSolvers, SolveATinyTrackingProblem) {
  const OwnedProblem problem = from_matrix({{-5, -4}, {-6, -1}}, {0, 0}, {0, 1});
  const Assign2dResult result = solve(problem);
  EXPECT_DOUBLE_EQ(result.cost, -10);
  EXPECT_THAT(result.column_of_row, ElementsAre(1, 0));
}

// A pair of cost 3 against outside costs 1 + 1 stays out; of cost 1 it is taken.
TEST_P(Assign2dSolvers, LeaveOutWhatCostsMoreThanTheOutsideOptions) {
  const Assign2dResult out = solve(from_matrix({{3}}, {1}, {1}));
  EXPECT_DOUBLE_EQ(out.cost, 2);
  EXPECT_THAT(out.column_of_row, ElementsAre(kUnassigned));
  EXPECT_THAT(out.u, ElementsAre(1));
  EXPECT_THAT(out.v, ElementsAre(1));
  const Assign2dResult in = solve(from_matrix({{1}}, {1}, {1}));
  EXPECT_DOUBLE_EQ(in.cost, 1);
  EXPECT_THAT(in.column_of_row, ElementsAre(0));
}

// A negative outside cost is a reward for staying out.
TEST_P(Assign2dSolvers, AcceptRewardsForStayingOut) {
  const Assign2dResult result = solve(from_matrix({{-3, 0}}, {-2}, {-2, -1}));
  EXPECT_DOUBLE_EQ(result.cost, -5);
}

// Three rows that must be assigned share two columns.
TEST_P(Assign2dSolvers, NameTheRowsThatCannotAllBeAssigned) {
  const OwnedProblem problem = from_matrix({{1, 2, kAbsent, kAbsent},
                                            {kAbsent, kAbsent, 1, 1},
                                            {1, 1, kAbsent, kAbsent},
                                            {5, 1, kInfinity, kAbsent}},
                                           std::vector<double>(4, kInfinity),
                                           std::vector<double>(4, 0));
  const Assign2dResult result = solve(problem);
  EXPECT_FALSE(result.feasible);
  EXPECT_EQ(result.cost, kInfinity);
  EXPECT_THAT(result.hall_rows, ElementsAre(0, 2, 3));
}

// The same for columns.
TEST_P(Assign2dSolvers, NameTheColumnsThatCannotAllBeAssigned) {
  const OwnedProblem problem =
      from_matrix({{-1, -1, kAbsent}, {kAbsent, kAbsent, -1}}, {0, 0}, {kInfinity, kInfinity, 0});
  const Assign2dResult result = solve(problem);
  EXPECT_FALSE(result.feasible);
  EXPECT_THAT(result.hall_columns, ElementsAre(0, 1));
}

TEST_P(Assign2dSolvers, SolveEmptyProblems) {
  EXPECT_EQ(solve(from_matrix({}, {}, {})).cost, 0);
  EXPECT_EQ(solve(from_matrix({}, {}, {2, 3})).cost, 5);
  EXPECT_EQ(solve(from_matrix({{}, {}}, {2, -3}, {})).cost, -1);
  EXPECT_EQ(solve(from_matrix({{kAbsent}}, {2}, {-3})).cost, -1);
  EXPECT_THAT(solve(from_matrix({{}}, {kInfinity}, {})).hall_rows, ElementsAre(0));
  EXPECT_THAT(solve(from_matrix({}, {}, {kInfinity})).hall_columns, ElementsAre(0));
}

TEST_P(Assign2dSolvers, FindTheOptimumOfSmallRandomProblems) {
  Random random(1);
  Assign2dResult result;
  for (int n = 0; n < 6000 && !HasFatalFailure(); ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = random_problem(support::random_recipe(6, random), random);
    solver_->solve(problem.view(), result);
    expect_optimum(problem, result);
  }
}

TEST_P(Assign2dSolvers, ProveTheOptimumOfLargerRandomProblems) {
  Random random(2);
  Assign2dResult result;
  for (int n = 0; n < 150; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = random_problem(support::random_recipe(60, random), random);
    solver_->solve(problem.view(), result);
    ASSERT_THAT(support::faults_of(problem.view(), result), IsEmpty());
  }
}

// Large enough for cores, blocks and long bidding wars.
TEST_P(Assign2dSolvers, ProveTheOptimumOfDenseProblems) {
  Random random(8);
  Assign2dResult result;
  for (const double highest : {1.0, 3.0, 1000.0}) {
    for (const bool integer : {false, true}) {
      for (const double must : {0.0, 0.5, 1.0}) {
        SCOPED_TRACE(::testing::Message() << highest << " " << integer << " " << must);
        Recipe recipe;
        recipe.num_rows = 150 + below(random, 2) * 13;
        recipe.num_columns = recipe.num_rows + below(random, 2) * 7;
        recipe.lowest = 0;
        recipe.highest = highest;
        recipe.integer = integer;
        recipe.must_rows = must;
        recipe.must_columns = recipe.num_rows == recipe.num_columns ? must : 0;
        const OwnedProblem problem = random_problem(recipe, random);
        solver_->solve(problem.view(), result);
        ASSERT_THAT(support::faults_of(problem.view(), result), IsEmpty());
        EXPECT_TRUE(result.feasible);
      }
    }
  }
}

// 160 rows and columns; the last 20 rows know only 19 columns, which everybody knows.
TEST_P(Assign2dSolvers, NameTheHallSetOfALargeMatrix) {
  Random random(9);
  Recipe recipe;
  recipe.num_rows = recipe.num_columns = 160;
  recipe.must_rows = recipe.must_columns = 1;
  OwnedProblem problem = random_problem(recipe, random);
  for (std::uint32_t i = 140; i < 160; ++i) {
    for (std::uint32_t j = 19; j < 160; ++j) problem.cost[i * 160 + j] = kInfinity;
  }
  EXPECT_FALSE(solve(problem).feasible);
}

// Changes costs as a dual loop does: a few, or all a little, or everything.
void change_costs(OwnedProblem& problem, const Recipe& recipe, Random& random) {
  const double share = below(random, 3) == 0 ? 1 : 0.2;
  const double step = below(random, 4) == 0 ? 1 : 0.05;
  for (std::vector<double>* costs :
       {&problem.cost, &problem.row_outside, &problem.column_outside}) {
    for (double& c : *costs) {
      if (c == kInfinity || support::uniform(random) >= share) continue;
      c += step * (random_cost(recipe, random) - c);
    }
  }
}

TEST_P(Assign2dSolvers, FindTheSameOptimumFromAWarmStart) {
  Random random(3);
  for (int n = 0; n < 150 && !HasFatalFailure(); ++n) {
    const Recipe recipe = support::random_recipe(7, random);
    OwnedProblem problem = random_problem(recipe, random);
    Assign2dResult result;
    solver_->solve(problem.view(), result);
    for (int step = 0; step < 15 && !HasFatalFailure(); ++step) {
      SCOPED_TRACE("problem " + std::to_string(n) + ", step " + std::to_string(step));
      change_costs(problem, recipe, random);
      solver_->solve_warm(problem.view(), result);
      expect_optimum(problem, result);
    }
  }
}

TEST_P(Assign2dSolvers, ProveTheOptimumFromAWarmStartOfALargerProblem) {
  Random random(4);
  for (int n = 0; n < 20; ++n) {
    const Recipe recipe = support::random_recipe(80, random);
    OwnedProblem problem = random_problem(recipe, random);
    Assign2dResult result;
    solver_->solve(problem.view(), result);
    for (int step = 0; step < 8; ++step) {
      SCOPED_TRACE("problem " + std::to_string(n) + ", step " + std::to_string(step));
      change_costs(problem, recipe, random);
      solver_->solve_warm(problem.view(), result);
      ASSERT_THAT(support::faults_of(problem.view(), result), IsEmpty());
    }
  }
}

TEST_P(Assign2dSolvers, StartWarmFromAnyResult) {
  Random random(5);
  Assign2dResult result;  // of the problem before: another shape, infeasible, other magnitudes
  for (int n = 0; n < 1500 && !HasFatalFailure(); ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    Recipe recipe = support::random_recipe(4, random);
    recipe.num_rows = std::max(3u, recipe.num_rows);
    recipe.num_columns = std::max(3u, recipe.num_columns);
    const OwnedProblem problem = random_problem(recipe, random);
    if (n % 7 == 0) result.v.assign(problem.column_outside.size(), std::nan(""));
    if (n % 7 == 1) result.v.assign(problem.column_outside.size(), -1e12);
    if (n % 7 == 2) result.u.clear();
    solver_->solve_warm(problem.view(), result);
    expect_optimum(problem, result);
  }
}

TEST_P(Assign2dSolvers, GiveTheSameAnswerTwice) {
  Random random(6);
  for (int n = 0; n < 50; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = random_problem(support::random_recipe(30, random), random);
    Assign2dResult first, second;
    solver_->solve(problem.view(), first);
    GetParam().make()->solve(problem.view(), second);
    EXPECT_EQ(first.column_of_row, second.column_of_row);
    EXPECT_EQ(first.u, second.u);
    EXPECT_EQ(first.v, second.v);
  }
}

TEST_P(Assign2dSolvers, AllocateNothingOnceWarm) {
  if (!GetParam().reuses_memory) GTEST_SKIP() << "the reference builds a graph each time";
  Random random(7);
  for (const double density : {0.1, 1.0}) {
    Recipe recipe;
    recipe.num_rows = 50;
    recipe.num_columns = 60;
    recipe.density = density;
    recipe.must_columns = 0.1;
    OwnedProblem problem = random_problem(recipe, random);
    OwnedProblem smaller = random_problem(support::random_recipe(40, random), random);
    Assign2dResult result;
    solver_->solve(problem.view(), result);
    solver_->solve(smaller.view(), result);
    for (int step = 0; step < 20; ++step) {
      SCOPED_TRACE("density " + std::to_string(density) + ", step " + std::to_string(step));
      change_costs(problem, recipe, random);
      const Assign2dProblem view = step % 3 == 2 ? smaller.view() : problem.view();
      EXPECT_EQ(support::count_allocations([&] { solver_->solve_warm(view, result); }), 0u);
      EXPECT_EQ(support::count_allocations([&] { solver_->solve(view, result); }), 0u);
    }
  }
}

// What has been listed is kept, so memory grows: by doubling, not with every assignment.
TEST(Assign2dRanking, HardlyAllocatesOnceItIsWarm) {
  Random random(1);
  Recipe recipe;
  recipe.num_rows = recipe.num_columns = 30;
  const OwnedProblem problem = random_problem(recipe, random);
  Assign2dRanking ranking(problem.view());
  Assign2dResult result;
  for (int n = 0; n < 500; ++n) ASSERT_TRUE(ranking.next(result));
  const std::size_t allocations = support::count_allocations([&] {
    for (int n = 0; n < 1000; ++n) ASSERT_TRUE(ranking.next(result));
  });
  EXPECT_LT(allocations, 60u);
}

const Implementation kImplementations[] = {
    {"Sparse", make<lap::SparseSolver>, true},
    {"Dense", make<lap::DenseSolver>, true},
    {"Core", make<lap::CoreSolver>, true},
    {"ShortestPath", make<lap::ShortestPathSolver>, true},
    {"Auction", make<lap::AuctionSolver>, true},
    {"NetworkSimplex", make<lap::NetworkSimplexSolver>, false},
};

INSTANTIATE_TEST_SUITE_P(All,
                         Assign2dSolvers,
                         ::testing::ValuesIn(kImplementations),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace nda
