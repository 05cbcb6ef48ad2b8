#include "nda/assign2d.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

#include "assign2d/brute_force.hpp"
#include "assign2d/certificate.hpp"
#include "assign2d/instances.hpp"

namespace nda {
namespace {

using support::from_matrix;
using support::OwnedProblem;
using support::Random;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Assign2dMethod kMethods[] = {
    Assign2dMethod::kShortestPath, Assign2dMethod::kAuction, Assign2dMethod::kNetworkSimplex};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class Assign2d : public ::testing::TestWithParam<Assign2dMethod> {};

INSTANTIATE_TEST_SUITE_P(All, Assign2d, ::testing::ValuesIn(kMethods));

TEST_P(Assign2d, SolvesASparseProblem) {
  const OwnedProblem problem = from_matrix({{-2, 1}}, {0}, {0, 0});
  const Assign2dResult result = assign2d(problem.view(), GetParam());
  EXPECT_DOUBLE_EQ(result.cost, -2);
  EXPECT_THAT(result.row_of_column, ElementsAre(0, kUnassigned));
}

// scipy.optimize.linear_sum_assignment's own example: cost 5 on (0,1) (1,0) (2,2).
TEST_P(Assign2d, SolvesADenseProblem) {
  const double cost[] = {4, 1, 3, 2, 0, 5, 3, 2, 2};
  const Assign2dResult result = assign2d(cost, 3, 3, GetParam());
  EXPECT_DOUBLE_EQ(result.cost, 5);
  EXPECT_THAT(result.column_of_row, ElementsAre(1, 0, 2));
}

TEST_P(Assign2d, AssignsAllOfTheSmallerSideOfADenseProblem) {
  const double cost[] = {7, 9, 8, 5, 6, 9};
  const Assign2dResult wide = assign2d(cost, 2, 3, GetParam());  // rows 7 9 8 and 5 6 9
  EXPECT_DOUBLE_EQ(wide.cost, 13);
  const Assign2dResult tall = assign2d(cost, 3, 2, GetParam());  // rows 7 9, 8 5 and 6 9
  EXPECT_DOUBLE_EQ(tall.cost, 11);
  EXPECT_THAT(tall.column_of_row, ElementsAre(kUnassigned, 1, 0));
}

TEST_P(Assign2d, AgreesWithBruteForceOnDenseProblems) {
  Random random(1);
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE("problem " + std::to_string(n));
    support::Recipe recipe;
    recipe.num_rows = support::below(random, 7);
    recipe.num_columns = support::below(random, 7);
    recipe.forbidden = 0.3;
    recipe.must_rows = recipe.num_rows <= recipe.num_columns ? 1 : 0;
    recipe.must_columns = recipe.num_columns <= recipe.num_rows ? 1 : 0;
    recipe.outside_factor = 0;
    const OwnedProblem problem = random_problem(recipe, random);
    const Assign2dResult result =
        assign2d(problem.cost, recipe.num_rows, recipe.num_columns, GetParam());
    EXPECT_THAT(support::faults_of(problem.view(), result), IsEmpty());
    const double optimum = support::brute_force_cost(problem.view());
    ASSERT_EQ(result.feasible, optimum < kInfinity);
    if (result.feasible) {
      EXPECT_NEAR(result.cost, optimum, 1e-10);
    }
  }
}

TEST_P(Assign2d, RejectsBadDenseInput) {
  const double cost[] = {1, std::nan(""), 3, -kInfinity};
  EXPECT_THAT(message_of([&] { assign2d(cost, 2, 3, GetParam()); }),
              HasSubstr("4 entries, not 2 x 3"));
  EXPECT_THAT(message_of([&] { assign2d(cost, 2, 2, GetParam()); }),
              HasSubstr("cost_row_major[1] is NaN"));
  EXPECT_THAT(message_of([&] { assign2d(std::span(cost).subspan(2), 1, 2, GetParam()); }),
              HasSubstr("cost_row_major[1] is -inf"));
}

// The cost matrix of an OR-Library file in arc format (all singletons cost 1000); empty if absent.
OwnedProblem read_orlib(const std::string& path, std::uint32_t size) {
  OwnedProblem problem;
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return problem;
  std::vector<double> matrix(std::size_t{size} * size, kInfinity);
  problem.row_outside.assign(size, 0);
  problem.column_outside.assign(size, 0);
  char line[200];
  unsigned i = 0, j = 0;
  double cost = 0;
  while (gzgets(file, line, sizeof line) != nullptr) {
    if (std::sscanf(line, "a %u %u %lf", &i, &j, &cost) != 3) continue;
    if (j == 0) problem.row_outside.at(i - 1) = cost;
    if (i == 0) problem.column_outside.at(j - 1) = cost;
    if (i > 0 && j > 0) matrix.at((i - 1) * size + (j - 1)) = cost;
  }
  gzclose(file);
  for (std::uint32_t row = 0; row < size; ++row) {
    for (std::uint32_t column = 0; column < size; ++column) {
      if (matrix[row * size + column] == kInfinity) continue;
      problem.column.push_back(column);
      problem.cost.push_back(matrix[row * size + column]);
    }
    problem.row_start.push_back(static_cast<std::uint32_t>(problem.column.size()));
  }
  return problem;
}

// Optima: J. E. Beasley, OR-Library, J. Oper. Res. Soc. 41 (1990) 1069-1072.
TEST_P(Assign2d, FindsTheOptimaOfTheOrLibrary) {
  const std::filesystem::path folder =
      std::filesystem::path(NDA_SOURCE_DIR) / "../shared/data/arcs/lap_orlib";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  const std::pair<std::uint32_t, double> optima[] = {
      {100, 305}, {200, 475}, {300, 626}, {400, 804}};
  for (const auto& [size, optimum] : optima) {
    const std::string path = (folder / ("assign" + std::to_string(size) + ".nda.gz")).string();
    SCOPED_TRACE(path);
    const OwnedProblem problem = read_orlib(path, size);
    ASSERT_EQ(problem.cost.size(), std::size_t{size} * size);
    const Assign2dResult result = assign2d(problem.view(), GetParam());
    EXPECT_THAT(support::faults_of(problem.view(), result), IsEmpty());
    EXPECT_DOUBLE_EQ(result.cost, optimum);
    EXPECT_DOUBLE_EQ(assign2d(problem.cost, size, size, GetParam()).cost, optimum);
  }
}

TEST(Assign2dValidate, NamesTheFirstFault) {
  const OwnedProblem good = from_matrix({{1, 2}, {3, 4}}, {0, 0}, {0, kInfinity});
  EXPECT_EQ(message_of([&] { validate(good.view()); }), "no error");
  const auto fault = [&](const std::function<void(OwnedProblem&)>& spoil) {
    OwnedProblem bad = good;
    spoil(bad);
    return message_of([&] { assign2d(bad.view()); });
  };
  EXPECT_THAT(fault([](auto& p) { p.row_start.pop_back(); }), HasSubstr("row_start has 2 entries"));
  EXPECT_THAT(fault([](auto& p) { p.cost.pop_back(); }), HasSubstr("column has 4 entries, cost 3"));
  EXPECT_THAT(fault([](auto& p) { p.row_start[0] = 1; }), HasSubstr("row_start[0] is not 0"));
  EXPECT_THAT(fault([](auto& p) { p.row_start[1] = 7; }), HasSubstr("row_start[2] is less"));
  EXPECT_THAT(fault([](auto& p) { p.row_start[2] = 3; }), HasSubstr("not the number of pairs"));
  EXPECT_THAT(fault([](auto& p) { p.column[3] = 2; }), HasSubstr("column[3] is 2 of 2"));
  EXPECT_THAT(fault([](auto& p) { p.column[3] = 0; }), HasSubstr("not above the entry before"));
  EXPECT_THAT(fault([](auto& p) { p.cost[2] = std::nan(""); }), HasSubstr("cost[2] is NaN"));
  EXPECT_THAT(fault([](auto& p) { p.row_outside[1] = -kInfinity; }),
              HasSubstr("row_outside[1] is -inf"));
  EXPECT_THAT(fault([](auto& p) { p.column_outside[0] = std::nan(""); }),
              HasSubstr("column_outside[0] is NaN"));
}

TEST(Assign2dSolver, IsMadeForKnownMethodsOnly) {
  EXPECT_THAT(message_of([] { make_assign2d_solver(static_cast<Assign2dMethod>(9)); }),
              HasSubstr("unknown two-dimensional method 9"));
}

}  // namespace
}  // namespace nda
