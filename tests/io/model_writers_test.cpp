#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <regex>

#include "io/io_support.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"

namespace nda::io {
namespace {

// Index 2 of dimension 1 has only its singleton, index 2 of dimension 2 nothing at all.
Problem small_problem() {
  ProblemBuilder builder({2, 2});
  builder.add_arc({1, 1}, -2.5);
  builder.add_arc({0, 1}, 1e-7);
  builder.add_arc({1, 0}, kInfinity);
  builder.add_arc({0, 2}, kInfinity);
  return std::move(builder).build();
}

TEST(LpWriter, WritesOneColumnPerArcAndSingletonAndOneRowPerIndex) {
  EXPECT_EQ(text_of(small_problem(), FileFormat::kLp),
            "minimize\n obj:\n - 2.5 x_1_1\n + 0 x_2_0\n + 1e-07 x_0_1\n + 0 never\n"
            "subject to\n"
            " c_1_1:\n + x_1_1 = 1\n"
            " c_1_2:\n + x_2_0 = 1\n"
            " c_2_1:\n + x_1_1\n + x_0_1 = 1\n"
            " c_2_2: never = 1\n"
            "bounds\n never = 0\nbinaries\n x_1_1\n x_2_0\n x_0_1\nend\n");
}

TEST(MpsWriter, WritesTheSameModel) {
  EXPECT_EQ(text_of(small_problem(), FileFormat::kMps),
            "NAME nda FREE\nROWS\n N cost\n E c_1_1\n E c_1_2\n E c_2_1\n E c_2_2\n"
            "COLUMNS\n M1 'MARKER' 'INTORG'\n"
            " x_1_1 cost -2.5\n x_1_1 c_1_1 1\n x_1_1 c_2_1 1\n"
            " x_2_0 cost 0 c_1_2 1\n x_0_1 cost 1e-07 c_2_1 1\n"
            " M2 'MARKER' 'INTEND'\n"
            "RHS\n rhs c_1_1 1\n rhs c_1_2 1\n rhs c_2_1 1\n rhs c_2_2 1\n"
            "BOUNDS\n BV bnd x_1_1\n BV bnd x_2_0\n BV bnd x_0_1\nENDATA\n");
}

// One index of each kind: 1..2 and 0..inf, 1..1, 2..2 with a forbidden singleton, 0..1.
Problem bounded_problem() {
  ProblemBuilder builder({2, 3});
  builder.add_arc({1, 1}, -2.5);
  builder.add_arc({2, 2}, -1);
  builder.add_arc({0, 2}, kInfinity);
  builder.set_use_bounds(0, 1, {1, 2});
  builder.set_use_bounds(0, 2, {0, UseBounds::kUnlimited});
  builder.set_use_bounds(1, 2, {2, 2});
  builder.set_use_bounds(1, 3, {0, 1});
  return std::move(builder).build();
}

TEST(NdaWriter, WritesBoundsFirst) {
  EXPECT_EQ(text_of(bounded_problem(), FileFormat::kNda),
            "p nda 2 2 3 3\nb 1 1 1 2\nb 1 2 0 inf\nb 2 2 2 2\nb 2 3 0 1\n"
            "a 0 2 inf\na 1 1 -2.5\na 2 2 -1\n");
}

TEST(NdaWriter, RestoresBounds) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = support::random_bounded_case(seed).problem;
    EXPECT_TRUE(same_problem(parse_problem(text_of(problem, FileFormat::kNda)), problem));
  }
}

TEST(CsvWriter, RefusesBounds) {
  EXPECT_EQ(message_of([] { text_of(bounded_problem(), FileFormat::kCsv); }),
            "format csv cannot deal with bounds on uses: index 1 of dimension 1 has bounds 1..2");
}

TEST(LpWriter, WritesBoundsAsTwoRowsAndWholeSingletons) {
  EXPECT_EQ(text_of(bounded_problem(), FileFormat::kLp),
            "minimize\n obj:\n - 2.5 x_1_1\n - 1 x_2_2\n + 0 x_1_0\n + 0 x_2_0\n + 0 x_0_1\n"
            " + 0 x_0_3\n + 0 never\n"
            "subject to\n"
            " c_1_1:\n + x_1_1\n + x_1_0 >= 1\n"
            " d_1_1:\n + x_1_1\n + x_1_0 <= 2\n"
            " c_1_2:\n + x_2_2\n + x_2_0 >= 0\n"
            " c_2_1:\n + x_1_1\n + x_0_1 = 1\n"
            " c_2_2:\n + x_2_2 = 2\n"
            " c_2_3:\n + x_0_3 >= 0\n"
            " d_2_3:\n + x_0_3 <= 1\n"
            "bounds\n never = 0\n 0 <= x_1_0 <= 2\n"
            "binaries\n x_1_1\n x_2_2\n x_0_1\n x_0_3\ngenerals\n x_1_0\n x_2_0\nend\n");
}

TEST(MpsWriter, WritesBoundsAsRanges) {
  EXPECT_EQ(text_of(bounded_problem(), FileFormat::kMps),
            "NAME nda FREE\nROWS\n N cost\n G c_1_1\n G c_1_2\n E c_2_1\n E c_2_2\n G c_2_3\n"
            "COLUMNS\n M1 'MARKER' 'INTORG'\n"
            " x_1_1 cost -2.5\n x_1_1 c_1_1 1\n x_1_1 c_2_1 1\n"
            " x_2_2 cost -1\n x_2_2 c_1_2 1\n x_2_2 c_2_2 1\n"
            " x_1_0 cost 0 c_1_1 1\n x_2_0 cost 0 c_1_2 1\n x_0_1 cost 0 c_2_1 1\n"
            " x_0_3 cost 0 c_2_3 1\n"
            " M2 'MARKER' 'INTEND'\n"
            "RHS\n rhs c_1_1 1\n rhs c_1_2 0\n rhs c_2_1 1\n rhs c_2_2 2\n rhs c_2_3 0\n"
            "RANGES\n rng c_1_1 1\n rng c_2_3 1\n"
            "BOUNDS\n BV bnd x_1_1\n BV bnd x_2_2\n UP bnd x_1_0 2\n PL bnd x_2_0\n"
            " BV bnd x_0_1\n BV bnd x_0_3\nENDATA\n");
}

TEST(LpWriter, NumbersTheColumnsWhereTuplesAreTooLongForNames) {
  ProblemBuilder builder(std::vector<Index>(64, 1));
  builder.add_arc(std::vector<Index>(64, 1), 3);
  const std::string text = text_of(std::move(builder).build(), FileFormat::kLp);
  EXPECT_THAT(text, ::testing::HasSubstr(" + 3 x1\n + 0 x2\n"));
  EXPECT_THAT(text, ::testing::HasSubstr(" c_64_1:\n + x1\n + x65 = 1\n"));
}

// What a program prints, both streams.
std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  std::string text;
  char block[4096];
  for (std::size_t count = 0; (count = std::fread(block, 1, sizeof block, pipe)) > 0;) {
    text.append(block, count);
  }
  ::pclose(pipe);
  return text;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

// The optimum another program prints, nothing if infeasible; fails the test if it says neither.
std::optional<double> optimum_in(const std::string& output,
                                 const std::regex& optimum,
                                 const std::regex& infeasible) {
  std::smatch match;
  if (std::regex_search(output, match, optimum)) return std::stod(match[1]);
  EXPECT_TRUE(std::regex_search(output, infeasible)) << output;
  return std::nullopt;
}

std::optional<double> solved_by_cbc(const std::string& path) {
  static const std::regex kOptimum("Objective value: +([-+.0-9e]+)");
  static const std::regex kInfeasible("infeasible");
  return optimum_in(output_of("cbc " + path + " ratio 0 allow 0 solve"), kOptimum, kInfeasible);
}

std::optional<double> solved_by_glpsol(const std::string& path) {
  const bool is_lp = path.ends_with(".lp");
  const std::string report = path + ".txt";
  output_of("glpsol " + std::string(is_lp ? "--lp " : "--freemps ") + path + " -o " + report);
  const std::string text = contents(report);
  static const std::regex kStatus("Status: +INTEGER OPTIMAL");
  static const std::regex kValue("Objective: +[a-z]+ = ([-+.0-9e]+)");
  if (!std::regex_search(text, kStatus)) return std::nullopt;
  std::smatch match;
  EXPECT_TRUE(std::regex_search(text, match, kValue)) << text;
  return std::stod(match[1]);
}

// Small random problems with every kind of singleton; some are infeasible.
void expect_same_optima(const char* program,
                        const std::function<std::optional<double>(const std::string&)>& solve) {
  if (!is_installed(program)) GTEST_SKIP() << program << " is not installed";
  const TemporaryFolder folder;
  int num_infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    support::RandomProblemOptions options;
    options.sizes = {3, 2, 3};
    options.singletons =
        seed % 2 == 0 ? support::SingletonKind::kMixed : support::SingletonKind::kForbidden;
    options.sign = support::SignKind::kMixed;
    options.plant = seed % 4 == 1;
    const Problem problem = support::random_problem(seed, options);
    const auto expected = support::brute_force(problem);
    num_infeasible += expected ? 0 : 1;
    for (const char* name : {"a.lp", "a.mps"}) {
      SCOPED_TRACE(::testing::Message() << name << ", seed " << seed);
      write_problem(problem, folder / name);
      const std::optional<double> actual = solve(folder / name);
      ASSERT_EQ(actual.has_value(), expected.has_value());
      if (actual) {
        ASSERT_NEAR(*actual, expected->cost, 1e-5);
      }
    }
  }
  EXPECT_GT(num_infeasible, 0);
  EXPECT_LT(num_infeasible, 20);
}

// Random problems with bounds on uses, both formats in turn.
void expect_same_bounded_optima(
    const char* program,
    std::uint64_t num_seeds,
    const std::function<std::optional<double>(const std::string&)>& solve) {
  if (!is_installed(program)) GTEST_SKIP() << program << " is not installed";
  const TemporaryFolder folder;
  std::uint64_t num_infeasible = 0;
  for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
    const support::RandomCase instance = support::random_bounded_case(seed);
    const char* name = seed % 2 == 0 ? "a.lp" : "a.mps";
    SCOPED_TRACE(name + (", " + instance.description));
    const auto expected = support::brute_force(instance.problem);
    num_infeasible += expected ? 0 : 1;
    write_problem(instance.problem, folder / name);
    const std::optional<double> actual = solve(folder / name);
    ASSERT_EQ(actual.has_value(), expected.has_value());
    if (actual) {
      ASSERT_NEAR(*actual, expected->cost, 1e-5);
    }
  }
  EXPECT_GT(num_infeasible, num_seeds / 20);
  EXPECT_LT(num_infeasible, num_seeds / 2);
}

// Names of every length up to 100 characters (33 dimensions of size 99) and numbered columns, costs
// of every length.  With few real indices an arc, a solution has many arcs.
void expect_same_optima_in_every_shape(
    const char* program, const std::function<std::optional<double>(const std::string&)>& solve) {
  if (!is_installed(program)) GTEST_SKIP() << program << " is not installed";
  const TemporaryFolder folder;
  constexpr std::pair<std::size_t, Index> kShapes[] = {{2, 50},
                                                       {3, 9},
                                                       {4, 50},
                                                       {5, 100},
                                                       {6, 12},
                                                       {9, 11},
                                                       {16, 30},
                                                       {33, 99},
                                                       {40, 9},
                                                       {49, 9},
                                                       {50, 2},
                                                       {64, 12}};
  for (const auto& [dimensions, size] : kShapes) {
    support::RandomProblemOptions options;
    options.sizes.assign(dimensions, size);
    options.num_arcs = 150;
    options.dummy_share = 1 - 2.5 / static_cast<double>(dimensions + 1);
    options.singletons = support::SingletonKind::kPriced;
    options.sign = support::SignKind::kMixed;
    const Problem problem = support::random_problem(dimensions, options);
    const Solution ours = nda::solve(problem);
    ASSERT_EQ(ours.status, Status::kOptimal);
    for (const char* name : {"a.lp", "a.mps"}) {
      SCOPED_TRACE(::testing::Message() << name << ", " << dimensions << " times " << size);
      write_problem(problem, folder / name);
      const std::optional<double> theirs = solve(folder / name);
      ASSERT_TRUE(theirs);
      EXPECT_NEAR(*theirs, ours.cost, 1e-6 * std::max(1.0, std::abs(ours.cost)));
    }
  }
}

TEST(ModelWriters, GiveCbcTheSameOptimumAsEnumeration) {
  expect_same_optima("cbc", solved_by_cbc);
}

TEST(ModelWriters, GiveCbcTheSameOptimumInEveryShape) {
  expect_same_optima_in_every_shape("cbc", solved_by_cbc);
}

TEST(ModelWriters, GiveGlpsolTheSameOptimumAsEnumeration) {
  expect_same_optima("glpsol", solved_by_glpsol);
}

TEST(ModelWriters, GiveGlpsolTheSameOptimumInEveryShape) {
  expect_same_optima_in_every_shape("glpsol", solved_by_glpsol);
}

TEST(ModelWriters, GiveCbcTheSameOptimumOfManyToOneProblems) {
  expect_same_bounded_optima("cbc", 300, solved_by_cbc);
}

TEST(ModelWriters, GiveGlpsolTheSameOptimumOfManyToOneProblems) {
  expect_same_bounded_optima("glpsol", 300, solved_by_glpsol);
}

}  // namespace
}  // namespace nda::io
