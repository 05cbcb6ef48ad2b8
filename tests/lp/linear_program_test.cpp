#include "lp/linear_program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace nda::lp {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

constexpr int kUnlimited = 1 << 30;
const core::Deadline kNever;

void add(LinearProgram& program, std::vector<int> rows, double cost) {
  const std::vector<double> ones(rows.size(), 1.0);
  program.add_column({rows, ones}, cost, kInfinity);
}

// Three rows, a column for each pair of them at -1: the fractional point (1/2, 1/2, 1/2) costs
// -1.5, its multipliers are -1/2 each; a packing takes one column, -1.
void make_triangle(LinearProgram& program) {
  program.add_empty_rows(3);
  add(program, {0, 1}, -1);
  add(program, {0, 2}, -1);
  add(program, {1, 2}, -1);
}

TEST(LinearProgram, SolvesTheTriangle) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1.5, 1e-9);
  EXPECT_THAT(program.primal(),
              ElementsAre(DoubleNear(0.5, 1e-9), DoubleNear(0.5, 1e-9), DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(program.dual(),
              ElementsAre(DoubleNear(-0.5, 1e-9), DoubleNear(-0.5, 1e-9), DoubleNear(-0.5, 1e-9)));
}

TEST(LinearProgram, GoesOnAfterARowIsAdded) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  const std::array columns = {0, 1, 2};
  const std::array<double, 3> ones = {1, 1, 1};
  program.add_row({columns, ones}, 1.0);
  program.add_row({columns, ones}, 2.0);
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1, 1e-9);
  EXPECT_FALSE(program.is_slack(3));
  EXPECT_TRUE(program.is_slack(4));
  program.remove_rows(std::array{4});
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1, 1e-9);
  program.remove_rows(std::array{3});
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1.5, 1e-9);
}

TEST(LinearProgram, GoesOnAfterColumnsComeAndGo) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  add(program, {0, 1, 2}, -4);
  EXPECT_EQ(program.num_columns(), 4);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -4, 1e-9);
  program.remove_columns(std::array{0, 3});
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_EQ(program.num_columns(), 2);
  EXPECT_NEAR(program.objective(), -1, 1e-9);
}

TEST(LinearProgram, BoundsAndEqualitiesComeAndGo) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  program.set_upper(0, 0.0);  // (0, 2) or (1, 2)
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1, 1e-9);
  program.set_equality(0, true);  // only (0, 2) covers row 0 now
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_NEAR(program.primal()[1], 1, 1e-9);
  program.set_equality(0, false);
  program.set_upper(0, kInfinity);
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1.5, 1e-9);
}

TEST(LinearProgram, SaysWhenTheObjectivePassesTheLimit) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  program.set_upper(0, 0.0);
  EXPECT_EQ(program.solve_dual(kNever, -1.2, kUnlimited), Outcome::kCutoff);
  EXPECT_EQ(program.solve_dual(kNever, -0.5, kUnlimited), Outcome::kOptimal);
}

TEST(LinearProgram, ComesBackToABasis) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  const std::vector<unsigned char> basis = program.basis();
  program.set_upper(0, 0.0);
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  program.set_upper(0, kInfinity);
  program.set_basis(basis);
  const std::int64_t before = program.iterations();
  ASSERT_EQ(program.solve_dual(kNever, kInfinity, kUnlimited), Outcome::kOptimal);
  EXPECT_EQ(program.iterations(), before);
  EXPECT_NEAR(program.objective(), -1.5, 1e-9);
}

// A copy taken at any moment goes on by itself, and bounds may change before it is solved.
TEST(LinearProgram, IsCopiedWithWhatWasJustAdded) {
  LinearProgram program;
  make_triangle(program);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  add(program, {0, 1, 2}, -2);
  LinearProgram copy = program;
  copy.set_upper(3, 0);
  const std::array columns = {0, 1, 2};
  const std::array<double, 3> ones = {1, 1, 1};
  program.add_row({columns, ones}, 0.5);
  LinearProgram other = program;
  ASSERT_EQ(copy.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(copy.objective(), -1.5, 1e-9);
  other.set_equality(3, true);
  ASSERT_EQ(other.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(other.objective(), -11.0 / 6, 1e-9);  // a sixth of each pair, 2/3 of all three
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -2, 1e-9);
}

TEST(LinearProgram, ABasisKnowsRowsJustAdded) {
  LinearProgram program;
  program.add_empty_rows(2);
  const int rows[] = {0, 1};
  const double ones[] = {1, 1};
  program.add_column({rows, ones}, -3, kInfinity);
  program.add_column({{rows, 1}, {ones, 1}}, -2, kInfinity);
  ASSERT_EQ(program.solve_primal({}), Outcome::kOptimal);
  const int columns[] = {0, 1};
  program.add_row({columns, ones}, 0.5);
  EXPECT_EQ(program.num_rows(), 3);
  const std::vector<unsigned char> basis = program.basis();
  EXPECT_EQ(basis.size(), 5u);
  program.set_basis(basis);
  ASSERT_EQ(program.solve_dual({}, kInfinity, 100), Outcome::kOptimal);
  EXPECT_NEAR(program.objective(), -1.5, 1e-9);
}

TEST(LinearProgram, StopsAtADeadlineThatHasPassed) {
  LinearProgram program;
  program.add_empty_rows(1);
  EXPECT_EQ(program.solve_primal(core::Deadline(0)), Outcome::kStopped);
}

TEST(LinearProgram, WithoutColumnsCostsNothing) {
  LinearProgram program;
  program.add_empty_rows(2);
  ASSERT_EQ(program.solve_primal(kNever), Outcome::kOptimal);
  EXPECT_EQ(program.objective(), 0);
}

}  // namespace
}  // namespace nda::lp
