#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "assign2d/all_assignments.hpp"
#include "assign2d/certificate.hpp"
#include "assign2d/instances.hpp"
#include "nda/assign2d_k_best.hpp"

namespace nda {
namespace {

using support::below;
using support::from_matrix;
using support::kAbsent;
using support::OwnedProblem;
using support::Random;
using support::random_problem;
using support::Recipe;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::size_t kAll = 1000000;

std::vector<double> costs_of(const std::vector<Assign2dResult>& results) {
  std::vector<double> costs;
  for (const Assign2dResult& result : results) costs.push_back(result.cost);
  return costs;
}

// Rounding of a sum over all members.
double tolerance(const Assign2dProblem& problem) {
  return 1e-12 * (problem.num_rows() + problem.num_columns()) * support::cost_scale(problem);
}

std::vector<Assign2dResult> list_all(const Assign2dProblem& problem) {
  return assign2d_k_best(problem, kAll);
}

// One list, cut anywhere, of different right assignments with the costs of all there are.
void expect_all_assignments(const OwnedProblem& owned, const std::vector<Assign2dResult>& results) {
  const Assign2dProblem problem = owned.view();
  const support::AllAssignments all(problem);
  ASSERT_THAT(results, SizeIs(all.costs().size()));
  std::set<std::vector<std::int32_t>> different;
  for (std::size_t n = 0; n < results.size(); ++n) {
    SCOPED_TRACE("rank " + std::to_string(n + 1));
    ASSERT_THAT(support::faults_of_assignment(problem, results[n]), IsEmpty());
    ASSERT_NEAR(results[n].cost, all.costs()[n], tolerance(problem));
    different.insert(results[n].column_of_row);
  }
  ASSERT_THAT(different, SizeIs(results.size()));
  if (results.empty()) return;
  ASSERT_THAT(support::faults_of(problem, results.front()), IsEmpty());
  ASSERT_EQ(results.back().u, results.front().u);
  ASSERT_EQ(results.back().v, results.front().v);
}

//      -5 -4     Outside costs: rows 0, 0; columns 0, 1.  Pairs by rows:
//      -6 -1     (0,1)(1,0): -10;  (0,0)(1,1): -6;  (1,0): -6 + 1 = -5;  (0,0): -5 + 1 = -4;
//                (0,1): -4;  (1,1): -1;  none: 1.
TEST(Assign2dKBest, ListsATinyProblem) {
  const OwnedProblem problem = from_matrix({{-5, -4}, {-6, -1}}, {0, 0}, {0, 1});
  const std::vector<Assign2dResult> results = assign2d_k_best(problem.view(), 10);
  EXPECT_THAT(costs_of(results), ElementsAre(-10, -6, -5, -4, -4, -1, 1));
  EXPECT_THAT(results[0].column_of_row, ElementsAre(1, 0));
  EXPECT_THAT(results[1].column_of_row, ElementsAre(0, 1));
  EXPECT_THAT(results[2].column_of_row, ElementsAre(kUnassigned, 0));
  EXPECT_THAT(results[2].row_of_column, ElementsAre(1, kUnassigned));
  EXPECT_THAT(results[6].column_of_row, ElementsAre(kUnassigned, kUnassigned));
}

//      7 5 2     All must be assigned.  By the columns of rows 0, 1, 2:
//      3 6 4     (2,1,0): 2 + 6 + 1 = 9;   (1,2,0): 5 + 4 + 1 = 10;  (2,0,1): 2 + 3 + 5 = 10;
//      1 5 5     (1,0,2): 5 + 3 + 5 = 13;  (0,2,1): 7 + 4 + 5 = 16;  (0,1,2): 7 + 6 + 5 = 18.
TEST(Assign2dKBest, ListsATinyDenseProblem) {
  const double cost[] = {7, 5, 2, 3, 6, 4, 1, 5, 5};
  const std::vector<Assign2dResult> results = assign2d_k_best(cost, 3, 3, 10);
  EXPECT_THAT(costs_of(results), ElementsAre(9, 10, 10, 13, 16, 18));
  EXPECT_THAT(results[0].column_of_row, ElementsAre(2, 1, 0));
}

TEST(Assign2dKBest, StopsAtK) {
  const double cost[] = {4, 1, 3, 2, 0, 5, 3, 2, 2};
  EXPECT_THAT(assign2d_k_best(cost, 3, 3, 0), IsEmpty());
  EXPECT_THAT(costs_of(assign2d_k_best(cost, 3, 3, 1)), ElementsAre(5));
  EXPECT_THAT(assign2d_k_best(cost, 3, 3, 4), SizeIs(4));
  EXPECT_THAT(assign2d_k_best(cost, 3, 3, 7), SizeIs(6));
}

TEST(Assign2dKBest, OfNoRowsOrNoColumnsIsOne) {
  EXPECT_THAT(costs_of(list_all(from_matrix({}, {}, {}).view())), ElementsAre(0));
  EXPECT_THAT(costs_of(list_all(from_matrix({}, {}, {1, 2}).view())), ElementsAre(3));
  EXPECT_THAT(costs_of(list_all(from_matrix({{}, {}}, {1, 2}, {}).view())), ElementsAre(3));
  EXPECT_THAT(list_all(from_matrix({}, {}, {1, kInfinity}).view()), IsEmpty());
  EXPECT_THAT(list_all(from_matrix({{}}, {kInfinity}, {}).view()), IsEmpty());
  EXPECT_THAT(costs_of(assign2d_k_best(std::span<const double>(), 0, 3, 5)), ElementsAre(0));
}

TEST(Assign2dKBest, OfForbiddenPairsOnlyIsOneOrNone) {
  const OwnedProblem free = from_matrix({{kInfinity, kInfinity}}, {1}, {2, 3});
  EXPECT_THAT(costs_of(list_all(free.view())), ElementsAre(6));
  const OwnedProblem bound = from_matrix({{kInfinity, kInfinity}}, {kInfinity}, {2, 3});
  EXPECT_THAT(list_all(bound.view()), IsEmpty());
}

TEST(Assign2dKBest, ListsEveryTieOnce) {
  const OwnedProblem problem = from_matrix(
      {{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}, {kInfinity, kInfinity, kInfinity}, {0, 0, 0, 0});
  const std::vector<Assign2dResult> results = list_all(problem.view());
  ASSERT_THAT(results, SizeIs(24));
  expect_all_assignments(problem, results);
}

TEST(Assign2dKBest, IsRightWhereNothingCostsAnything) {
  const OwnedProblem problem = from_matrix({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0}, {0, 0, 0});
  const std::vector<Assign2dResult> results = list_all(problem.view());
  ASSERT_THAT(results, SizeIs(34));
  expect_all_assignments(problem, results);
}

class Assign2dKBestOfRandom : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Seeds, Assign2dKBestOfRandom, ::testing::Range(0, 10));

TEST_P(Assign2dKBestOfRandom, EqualsEnumeration) {
  Random random(GetParam());
  std::size_t num_ranks = 0;
  for (int n = 0; n < 600; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    Recipe recipe = support::random_recipe(6, random);
    if (n % 2 == 0) recipe.must_rows = 0;
    const OwnedProblem problem = random_problem(recipe, random);
    const std::vector<Assign2dResult> results = list_all(problem.view());
    ASSERT_NO_FATAL_FAILURE(expect_all_assignments(problem, results));
    num_ranks += results.size();
  }
  EXPECT_GT(num_ranks, 10000U);
}

// Rows and columns enough for a first reach that is not all, and pairs out of reach.
TEST_P(Assign2dKBestOfRandom, EqualsEnumerationOfManySparseRows) {
  Random random(100 + GetParam());
  for (int n = 0; n < 10; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    Recipe recipe;
    recipe.num_rows = 40;
    recipe.num_columns = 40;
    recipe.density = 0.01;
    recipe.must_rows = 0.5;
    recipe.must_columns = 0.2;
    recipe.integer = n % 2 == 0;
    recipe.outside_factor = n % 3 == 0 ? 20 : 1;
    const OwnedProblem problem = random_problem(recipe, random);
    ASSERT_NO_FATAL_FAILURE(expect_all_assignments(problem, list_all(problem.view())));
  }
}

TEST(Assign2dRanking, GoesOnWhereItStopped) {
  Random random(7);
  const OwnedProblem problem = random_problem({4, 4, 1, 0, 0.3, 0.3, 0, 9, 1, true}, random);
  const std::vector<Assign2dResult> expected = list_all(problem.view());
  ASSERT_GT(expected.size(), 10U);
  Assign2dRanking first(problem.view());
  Assign2dResult result;
  std::vector<double> costs;
  for (int n = 0; n < 5; ++n) {
    ASSERT_TRUE(first.next(result));
    costs.push_back(result.cost);
  }
  Assign2dRanking ranking = std::move(first);
  while (ranking.next(result)) costs.push_back(result.cost);
  EXPECT_EQ(costs, costs_of(expected));
  const Assign2dResult last = result;
  EXPECT_FALSE(ranking.next(result));
  EXPECT_EQ(result.column_of_row, last.column_of_row);
}

TEST(Assign2dRanking, KeepsWhatItNeeds) {
  std::vector<double> costs;
  std::optional<Assign2dRanking> ranking;
  {
    OwnedProblem problem = from_matrix({{-5, -4}, {-6, -1}}, {0, 0}, {0, 1});
    ranking.emplace(problem.view());
    problem.cost.assign(4, 0);
  }
  for (Assign2dResult result; ranking->next(result);) costs.push_back(result.cost);
  EXPECT_THAT(costs, ElementsAre(-10, -6, -5, -4, -4, -1, 1));
}

OwnedProblem medium_problem(std::uint32_t size, Random& random) {
  Recipe recipe;
  recipe.num_rows = size;
  recipe.num_columns = size + below(random, 3);
  recipe.density = below(random, 2) == 0 ? 1 : 0.1;
  recipe.must_rows = below(random, 2) == 0 ? 0.9 : 0;
  recipe.must_columns = 0.1;
  recipe.outside_factor = 2;
  return random_problem(recipe, random);
}

// The sum that a row's costs, its outside option among them, are shifted by comes back in every
// cost.
TEST(Assign2dKBest, MovesWithTheCostsOfARow) {
  Random random(8);
  for (int n = 0; n < 20; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = medium_problem(40, random);
    OwnedProblem shifted = problem;
    for (std::uint32_t k = shifted.row_start[3]; k < shifted.row_start[4]; ++k)
      shifted.cost[k] += 5;
    shifted.row_outside[3] += 5;
    for (double& outside : shifted.column_outside) outside -= 1;
    for (double& cost : shifted.cost) cost -= 1;
    const auto results = assign2d_k_best(problem.view(), 200);
    const auto moved = assign2d_k_best(shifted.view(), 200);
    ASSERT_EQ(moved.size(), results.size());
    const double change = 5.0 - problem.view().num_columns();
    for (std::size_t rank = 0; rank < results.size(); ++rank) {
      ASSERT_NEAR(moved[rank].cost, results[rank].cost + change, tolerance(shifted.view()));
    }
  }
}

// Rows in reverse order and columns turned round.
OwnedProblem permuted(const OwnedProblem& problem) {
  const std::uint32_t num_rows = problem.view().num_rows();
  const std::uint32_t num_columns = problem.view().num_columns();
  std::vector<std::vector<double>> matrix(num_rows, std::vector<double>(num_columns, kAbsent));
  for (std::uint32_t i = 0; i < num_rows; ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      matrix[num_rows - 1 - i][(problem.column[k] + 5) % num_columns] = problem.cost[k];
    }
  }
  std::vector<double> columns(num_columns);
  for (std::uint32_t j = 0; j < num_columns; ++j) {
    columns[(j + 5) % num_columns] = problem.column_outside[j];
  }
  return from_matrix(matrix, {problem.row_outside.rbegin(), problem.row_outside.rend()}, columns);
}

TEST(Assign2dKBest, DoesNotDependOnTheOrderOfRowsAndColumns) {
  Random random(9);
  for (int n = 0; n < 20; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = medium_problem(40, random);
    const auto results = assign2d_k_best(problem.view(), 200);
    const auto turned = assign2d_k_best(permuted(problem).view(), 200);
    ASSERT_EQ(turned.size(), results.size());
    for (std::size_t rank = 0; rank < results.size(); ++rank) {
      ASSERT_NEAR(turned[rank].cost, results[rank].cost, tolerance(problem.view()));
    }
  }
}

TEST(Assign2dKBest, ListsThousandsInOrderAndNoneTwice) {
  Random random(10);
  for (int n = 0; n < 4; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    const OwnedProblem problem = medium_problem(60, random);
    const auto results = assign2d_k_best(problem.view(), 3000);
    std::set<std::vector<std::int32_t>> different;
    for (std::size_t rank = 0; rank < results.size(); ++rank) {
      ASSERT_THAT(support::faults_of_assignment(problem.view(), results[rank]), IsEmpty());
      different.insert(results[rank].column_of_row);
      if (rank == 0) continue;
      ASSERT_GE(results[rank].cost, results[rank - 1].cost - tolerance(problem.view()));
    }
    ASSERT_THAT(different, SizeIs(results.size()));
  }
}

TEST(Assign2dKBest, RejectsBadInput) {
  const double cost[] = {1, std::nan(""), 3, -kInfinity};
  EXPECT_THROW(assign2d_k_best(cost, 2, 3, 1), InputError);
  EXPECT_THROW(assign2d_k_best(cost, 2, 2, 1), InputError);
  OwnedProblem problem = from_matrix({{1, 2}}, {0}, {0, 0});
  problem.column[1] = 2;
  EXPECT_THROW(assign2d_k_best(problem.view(), 1), InputError);
}

}  // namespace
}  // namespace nda
