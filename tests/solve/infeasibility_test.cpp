#include "solve/infeasibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "core/random.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

// `rows` rows without singletons, `columns` columns, all pairs.
Problem rows_and_columns(Index rows, Index columns) {
  ProblemBuilder builder({rows, columns});
  for (Index i = 1; i <= rows; ++i) {
    builder.add_arc({i, 0}, kInfinity);
    for (Index j = 1; j <= columns; ++j) builder.add_arc({i, j}, 1);
  }
  return std::move(builder).build();
}

TEST(InfeasibilityReason, NamesAnIndexWithoutArcsFirst) {
  const Problem problem = support::make_problem({2, 1}, {{{1, 1}, 1}}, kInfinity);
  EXPECT_EQ(infeasibility_reason(problem, {{0, 2}}),
            "index 2 of dimension 1 has no arc and its singleton is forbidden");
}

TEST(InfeasibilityReason, NamesAHallSetAndItsPartners) {
  EXPECT_EQ(infeasibility_reason(rows_and_columns(2, 1), {{0, 2}}),
            "indices 1, 2 of dimension 1 cannot all be covered: each of their arcs uses index 1 of "
            "dimension 2");
  EXPECT_EQ(infeasibility_reason(rows_and_columns(3, 2), {{0, 2}}),
            "indices 1, 2, 3 of dimension 1 cannot all be covered: each of their arcs uses one of "
            "indices 1, 2 of dimension 2");
  EXPECT_EQ(infeasibility_reason(support::infeasible_by_hall().problem, {{0, 2}}),
            "indices 1, 2 of dimension 1 cannot all be covered: each of their arcs uses index 1 of "
            "dimension 2");
}

TEST(InfeasibilityReason, DoesNotListThemAll) {
  const std::string reason = infeasibility_reason(rows_and_columns(40, 39), {{0, 40}});
  EXPECT_THAT(reason, HasSubstr("8, 9, 10 of dimension 1 and 30 more cannot all be covered"));
  EXPECT_THAT(reason, HasSubstr("9, 10 of dimension 2 and 29 more"));
}

TEST(InfeasibilityReason, NamesASetThatNoTwoDimensionsShow) {
  EXPECT_EQ(infeasibility_reason(support::infeasible_by_parity().problem, {{0, 2}}),
            "indices 1, 2 of dimension 1 cannot all be covered");
}

// Indices 1, 2 of dimension 1 block one another and everybody, whose many arcs hide it.
TEST(InfeasibilityReason, NamesTheFewThatTheProofNeedsAmongMany) {
  constexpr Index kSize = 60;
  ProblemBuilder builder({kSize, kSize, kSize});
  for (const auto& arc :
       std::vector<std::vector<Index>>{{1, 1, 1}, {1, 2, 2}, {2, 1, 2}, {2, 2, 1}}) {
    builder.add_arc(arc, 1);
  }
  for (Index i = 3; i <= kSize; ++i) {
    for (Index j = 1; j <= kSize; ++j) builder.add_arc({i, j, (i + j) % kSize + 1}, 1);
  }
  for (Index i = 1; i <= kSize; ++i) {
    builder.add_arc({i, 0, 0}, kInfinity);
    builder.add_arc({0, i, 0}, kInfinity);
    builder.add_arc({0, 0, i}, kInfinity);
  }
  const Problem problem = std::move(builder).build();
  EXPECT_EQ(infeasibility_reason(problem, {{0, 1}}),
            "indices 1, 2 of dimension 1 cannot all be covered");
}

// What every arc is in conflict with, over and over, took minutes and all the memory.
TEST(InfeasibilityReason, LooksAtAnArcOnceAStep) {
  constexpr Index kSize = 20000;
  ProblemBuilder builder({5, kSize, kSize, kSize, kSize});
  for (Index i = 1; i <= kSize; ++i) {
    builder.add_arc({i % 5 + 1, i, i, i, i}, 1);
    for (int k = 1; k < 5; ++k) {
      std::vector<Index> alone(5, 0);
      alone[static_cast<std::size_t>(k)] = i;
      builder.add_arc(alone, kInfinity);
    }
  }
  for (Index i = 1; i <= 5; ++i) builder.add_arc({i, 0, 0, 0, 0}, kInfinity);
  const Problem problem = std::move(builder).build();
  EXPECT_THAT(infeasibility_reason(problem, {{0, 1}}), HasSubstr("cannot all be covered"));
}

TEST(InfeasibilityReason, IsNotLookedForAfterTheDeadline) {
  EXPECT_THAT(infeasibility_reason(rows_and_columns(2, 1), {{0, 2}}, core::Deadline(0)),
              HasSubstr("at least 1 stays uncovered"));
  EXPECT_THAT(
      infeasibility_reason(support::infeasible_by_parity().problem, {{0, 2}}, core::Deadline(0)),
      HasSubstr("at least 1 stays uncovered"));
}

TEST(InfeasibilityReason, SaysHowManyWhereItFindsNoSet) {
  EXPECT_EQ(infeasibility_reason(rows_and_columns(3, 3), {{0, 3}}),
            "not all indices with forbidden singletons can be covered at once: at least 1 stays "
            "uncovered, for instance index 3 of dimension 1");
  EXPECT_THAT(infeasibility_reason(rows_and_columns(3, 3), {{0, 1}, {0, 2}}),
              HasSubstr("at least 2 stay uncovered, for instance indices 1, 2 of dimension 1"));
}

// The indices that a reason says cannot all be covered.
std::vector<RealIndex> named(const std::string& reason) {
  const std::string head = reason.substr(0, reason.find(" cannot all "));
  static const std::regex kGroup("ind(?:ex|ices) ([0-9, ]+) of dimension ([0-9]+)");
  std::vector<RealIndex> indices;
  for (std::sregex_iterator group(head.begin(), head.end(), kGroup), end; group != end; ++group) {
    std::stringstream numbers((*group)[1]);
    for (std::string number; std::getline(numbers, number, ',');) {
      indices.push_back({std::stoi((*group)[2]) - 1, static_cast<Index>(std::stoul(number))});
    }
  }
  return indices;
}

// The same problem in which only these indices must be covered by an arc.
Problem needing_only(const Problem& problem, const std::vector<RealIndex>& indices) {
  ProblemBuilder builder({problem.sizes().begin(), problem.sizes().end()});
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) builder.add_arc(problem.arc(a), 0);
  for (const RealIndex& index : indices) {
    std::vector<Index> tuple(problem.sizes().size(), 0);
    tuple[static_cast<std::size_t>(index.dimension)] = index.index;
    builder.add_arc(tuple, kInfinity);
  }
  return std::move(builder).build();
}

TEST(InfeasibilityReason, NamesASetThatCannotBeCoveredWhateverElseCan) {
  int num_infeasible = 0, num_without_arcs = 0, num_hall = 0;
  for (std::uint64_t seed = 1; num_infeasible < 1000; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.sizes.assign(2 + seed % 4, 2 + static_cast<Index>(seed / 4 % 3));
    options.num_arcs = 10 + static_cast<int>(seed % 13);
    options.dummy_share = seed % 3 == 0 ? 0 : 0.3;
    options.singletons =
        seed % 2 == 0 ? support::SingletonKind::kMixed : support::SingletonKind::kForbidden;
    const Problem problem = support::random_problem(seed, options);
    const Solution solution = solve(problem);
    if (solution.status != Status::kInfeasible) continue;
    ++num_infeasible;
    const std::vector<RealIndex> indices = named(solution.reason);
    ASSERT_FALSE(indices.empty()) << solution.reason;
    ASSERT_THAT(solution.reason, Not(HasSubstr(" more")));
    for (const RealIndex& index : indices) {
      ASSERT_EQ(problem.singleton_costs(index.dimension)[index.index], kInfinity);
    }
    ASSERT_FALSE(support::brute_force(needing_only(problem, indices))) << solution.reason;
    num_hall += solution.reason.find("each of their arcs") != std::string::npos;
    num_without_arcs += indices.size() == 1;
  }
  EXPECT_GT(num_without_arcs, 50);
  EXPECT_GT(num_hall, 50);
  EXPECT_GT(num_infeasible - num_without_arcs - num_hall, 50);
}

TEST(Infeasibility, IsProvenByABoundAboveAllSolutions) {
  ProblemBuilder builder({30, 30, 29});
  core::Random random(1);
  for (Index i = 1; i <= 30; ++i) {
    builder.add_arc({i, 0, 0}, kInfinity);
    for (int n = 0; n < 40; ++n) {
      const auto any = [&](std::uint64_t size) {
        return static_cast<Index>(1 + random.below(size));
      };
      builder.add_arc({i, any(30), any(29)}, random.uniform(-10, 10));
    }
  }
  Options options;
  options.method = Method::kRelaxation;
  EXPECT_EQ(solve(std::move(builder).build(), options).status, Status::kInfeasible);
}

TEST(IndicesWithoutArcs, AreThoseThatNothingCanCover) {
  const Problem problem = support::make_problem(
      {2, 2}, {{{1, 1}, 1}, {{2, 0}, kInfinity}, {{0, 1}, kInfinity}, {{0, 2}, 3}});
  const std::vector<RealIndex> lonely = indices_without_arcs(problem);
  ASSERT_THAT(lonely, SizeIs(1));
  EXPECT_EQ(lonely[0], (RealIndex{0, 2}));
  EXPECT_THAT(indices_without_arcs(rows_and_columns(10, 1)), IsEmpty());
}

}  // namespace
}  // namespace nda::pipeline
