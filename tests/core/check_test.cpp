#include "nda/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/right_solution.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using core::right_solution;
using support::make_problem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const double kNan = std::nan("");

// Singletons 1; index 2 of dimension 1 must be covered.  Best: (1,1,1) + (2,2,0) = 5 covers all,
// u = 0 2 | 1 1 | 1 proves it.  (2,2,0) alone costs 6, (2,1,0) alone 7.
Problem checked_problem() {
  return make_problem(
      {2, 2, 1},
      {{{2, 0, 0}, kInfinity}, {{1, 1, 1}, 2}, {{2, 1, 0}, 4}, {{2, 2, 0}, 3}, {{1, 2, 0}, 9}},
      1);
}

Solution checked_solution() {
  const Problem problem = checked_problem();
  const auto best = support::brute_force(problem);
  return right_solution(problem, *best, {{0, 2}, {1, 1}, {1}});
}

// The report after one change of a right solution.
CheckReport report_after(const std::function<void(Solution&)>& change) {
  Solution solution = checked_solution();
  change(solution);
  return check(checked_problem(), solution);
}

TEST(Check, AcceptsARightSolution) {
  const CheckReport report = report_after([](Solution&) {});
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_TRUE(report.passed());
  EXPECT_TRUE(report.feasible);
  EXPECT_TRUE(report.cost_right);
  EXPECT_TRUE(report.bound_right);
  EXPECT_FALSE(report.bound_by_branching);
  EXPECT_EQ(report.cost, checked_solution().cost);
  EXPECT_EQ(report.certificate_bound, checked_solution().lower_bound);
}

TEST(Check, AcceptsTheOptimumOfEveryTinyProblem) {
  for (const support::TinyProblem& tiny : support::all_tiny_problems()) {
    SCOPED_TRACE(tiny.name);
    if (!tiny.optimum) continue;
    const auto best = support::brute_force(tiny.problem);
    const CheckReport report = check(tiny.problem, right_solution(tiny.problem, *best, tiny.dual));
    EXPECT_THAT(report.faults, IsEmpty());
    EXPECT_DOUBLE_EQ(report.cost, *tiny.optimum);
    EXPECT_DOUBLE_EQ(report.certificate_bound, *tiny.lp_value);
  }
}

TEST(Check, AcceptsABoundBelowTheCertificate) {
  EXPECT_TRUE(report_after([](Solution& s) { s.lower_bound -= 1; }).passed());
  EXPECT_TRUE(report_after([](Solution& s) { s.lower_bound = -kInfinity; }).passed());
}

TEST(Check, AcceptsALimitWithoutASolution) {
  const CheckReport report = report_after([](Solution& s) {
    s.solutions.clear();
    s.cost = kInfinity;
  });
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_EQ(report.cost, kInfinity);
}

void claim_infeasible(Solution& solution) {
  solution.status = Status::kInfeasible;
  solution.reason = "index 2 of dimension 1 cannot be covered";
  solution.solutions.clear();
  solution.cost = solution.lower_bound = kInfinity;
  solution.multipliers.clear();
  solution.stats.certificate_bound = -kInfinity;
}

TEST(Check, CannotTellAnInfeasibleProblemFromAnother) {
  const CheckReport report = report_after(claim_infeasible);
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_FALSE(report.feasible);
  EXPECT_FALSE(report.bound_right) << "the claim is false, only nobody can see it";
  EXPECT_TRUE(report.bound_by_branching);
}

TEST(Check, SeesAnIndexThatNothingCanCover) {
  const Problem problem = make_problem({2, 1}, {{{1, 1}, 1}, {{2, 0}, kInfinity}});
  Solution solution;
  solution.sizes = {2, 1};
  solution.num_arcs = 1;
  claim_infeasible(solution);
  const CheckReport report = check(problem, solution);
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_TRUE(report.bound_right);
  EXPECT_FALSE(report.bound_by_branching);
}

TEST(Check, DeniesInfeasibilityWhereAllSingletonsAreFree) {
  const Problem problem = make_problem({1, 1}, {{{1, 1}, -3}}, 2);
  Solution solution = right_solution(problem, *support::brute_force(problem), {{-3}, {0}});
  claim_infeasible(solution);
  const CheckReport report = check(problem, solution);
  EXPECT_THAT(report.faults, ElementsAre(HasSubstr("no singleton is forbidden")));
  EXPECT_FALSE(report.bound_right);
  EXPECT_FALSE(report.bound_by_branching);
}

TEST(Check, DeniesALimitWithoutASolutionWhereAllSingletonsAreFree) {
  const Problem problem = make_problem({1, 1}, {{{1, 1}, -3}}, 2);
  Solution solution = right_solution(problem, *support::brute_force(problem), {{-3}, {0}});
  solution.solutions.clear();
  solution.cost = kInfinity;
  solution.status = Status::kTimeLimit;
  EXPECT_THAT(check(problem, solution).faults, ElementsAre(HasSubstr("leaving all alone is one")));
}

// An arc that no solution needs, however dear, excuses no gap.
TEST(Check, JudgesAGapByTheCostsThatWereChosen) {
  const Problem problem = make_problem({2, 1}, {{{1, 1}, -3000}, {{2, 1}, 1e12}});
  Solution solution = right_solution(problem, *support::brute_force(problem), {{-3000, 0}, {0}});
  solution.status = Status::kOptimal;
  solution.proven = solution.solutions[0].proven = true;
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  solution.lower_bound -= 0.1;
  EXPECT_THAT(check(problem, solution).faults, ElementsAre(HasSubstr("does not meet it")));
}

// Which gap was asked for is not in the file.
TEST(Check, DoesNotJudgeTheGapThatWasReached) {
  const CheckReport report = report_after([](Solution& s) {
    s.status = Status::kGapReached;
    s.lower_bound = -1e9;
  });
  EXPECT_THAT(report.faults, IsEmpty());
}

TEST(Check, TellsABoundThatRestsOnBranching) {
  const CheckReport report = report_after([](Solution& s) {
    for (std::vector<double>& row : s.multipliers) std::fill(row.begin(), row.end(), 0.0);
    s.stats.certificate_bound = 0;
    s.stats.bound_by_branching = true;
  });
  EXPECT_TRUE(report.passed());
  EXPECT_TRUE(report.bound_by_branching);
  EXPECT_FALSE(report.bound_right) << "the multipliers do not prove it";
}

TEST(Check, LooksAtEverySolutionOfAList) {
  const auto append = [](Solution& s, double cost, std::vector<std::vector<Index>> arcs) {
    s.solutions.push_back({2, cost, false, std::move(arcs)});
  };
  EXPECT_TRUE(report_after([&](Solution& s) { append(s, 5, {{2, 2, 0}, {1, 1, 1}}); }).passed());
  const CheckReport wrong_cost = report_after([&](Solution& s) {
    append(s, 5.5, {{2, 2, 0}, {1, 1, 1}});
  });
  EXPECT_THAT(wrong_cost.faults, ElementsAre(HasSubstr("solution 2 states cost 5.5")));
  const CheckReport wrong_arc = report_after([&](Solution& s) { append(s, 2, {{1, 1, 1}}); });
  EXPECT_FALSE(wrong_arc.feasible);
}

struct Wrong {
  const char* name;
  std::function<void(Solution&)> change;
  const char* fault;  // part of the sentence
};

void PrintTo(const Wrong& wrong, std::ostream* out) {
  *out << wrong.name;
}

class WrongSolutions : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongSolutions, AreRejectedWithTheReason) {
  const CheckReport report = report_after(GetParam().change);
  EXPECT_FALSE(report.passed());
  EXPECT_THAT(report.faults, Contains(HasSubstr(GetParam().fault)));
}

INSTANTIATE_TEST_SUITE_P(
    Structure,
    WrongSolutions,
    ::testing::Values(
        Wrong{"arc_missing_from_problem",
              [](Solution& s) {
                s.solutions[0].arcs[0] = {1, 2, 1};
              },
              "arc (1 2 1) is not in the problem"},
        Wrong{"tuple_too_short",
              [](Solution& s) {
                s.solutions[0].arcs[0] = {1, 1};
              },
              "arc (1 1) is not in the problem"},
        Wrong{"empty_tuple", [](Solution& s) { s.solutions[0].arcs[0] = {}; }, "arc () is not"},
        Wrong{"index_out_of_range",
              [](Solution& s) {
                s.solutions[0].arcs[0] = {1, 7, 1};
              },
              "arc (1 7 1) is not"},
        Wrong{"singleton_listed",
              [](Solution& s) {
                s.solutions[0].arcs.push_back({1, 0, 0});
              },
              "arc (1 0 0) is not"},
        Wrong{"index_twice",
              [](Solution& s) {
                s.solutions[0].arcs.push_back({2, 1, 0});
              },
              "index 2 of dimension 1 is used twice"},
        Wrong{"arc_twice",
              [](Solution& s) {
                s.solutions[0].arcs.push_back({1, 1, 1});
              },
              "index 1 of dimension 3 is used twice"},
        Wrong{"forbidden_uncovered",
              [](Solution& s) {
                s.solutions[0].arcs = {{1, 1, 1}};
              },
              "index 2 of dimension 1 is uncovered and its singleton forbidden"},
        Wrong{"other_sizes",
              [](Solution& s) {
                s.sizes = {2, 2, 2};
              },
              "other sizes"},
        Wrong{"fewer_dimensions", [](Solution& s) { s.sizes.pop_back(); }, "other sizes"},
        Wrong{"more_dimensions", [](Solution& s) { s.sizes.push_back(1); }, "other sizes"},
        Wrong{"no_sizes", [](Solution& s) { s.sizes.clear(); }, "other sizes"}),
    [](const auto& tested) { return tested.param.name; });

void set_cost(Solution& solution, double cost) {
  solution.cost = solution.solutions[0].cost = cost;
}

INSTANTIATE_TEST_SUITE_P(
    Cost,
    WrongSolutions,
    ::testing::Values(
        Wrong{"cost_too_low", [](Solution& s) { set_cost(s, 4.99999); }, "states cost 4.99999"},
        Wrong{"cost_too_high", [](Solution& s) { set_cost(s, 5.00001); }, "states cost"},
        Wrong{"cost_infinite", [](Solution& s) { set_cost(s, kInfinity); }, "states cost inf"},
        Wrong{"cost_minus_infinite",
              [](Solution& s) { set_cost(s, -kInfinity); },
              "states cost -inf"},
        Wrong{"cost_nan", [](Solution& s) { set_cost(s, kNan); }, "states cost"},
        Wrong{"total_differs_from_first",
              [](Solution& s) { s.cost = 4; },
              "cost 4 is not that of the first solution"},
        Wrong{"total_nan", [](Solution& s) { s.cost = kNan; }, "is not that of the first"},
        Wrong{"cost_without_solution", [](Solution& s) { s.solutions.clear(); }, "inf"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Bound,
    WrongSolutions,
    ::testing::Values(
        Wrong{"bound_above_certificate",
              [](Solution& s) { s.lower_bound += 1e-6; },
              "the multipliers prove only"},
        Wrong{"bound_infinite", [](Solution& s) { s.lower_bound = kInfinity; }, "lower bound inf"},
        Wrong{"bound_nan", [](Solution& s) { s.lower_bound = kNan; }, "lower bound"},
        Wrong{"multiplier_changed",
              [](Solution& s) { s.multipliers[1][0] += 1; },
              "the multipliers prove only"},
        Wrong{"multiplier_nan",
              [](Solution& s) { s.multipliers[2][0] = kNan; },
              "multiplier of dimension 3 is not finite"},
        Wrong{"multiplier_infinite",
              [](Solution& s) { s.multipliers[0][1] = -kInfinity; },
              "multiplier of dimension 1 is not finite"},
        Wrong{"multiplier_missing",
              [](Solution& s) { s.multipliers[1].pop_back(); },
              "dimension 2 has 1 multipliers, not 2"},
        Wrong{"multiplier_too_many",
              [](Solution& s) { s.multipliers[2].push_back(0); },
              "dimension 3 has 2 multipliers, not 1"},
        Wrong{"dimension_missing", [](Solution& s) { s.multipliers.pop_back(); }, "of 2 dimens"},
        Wrong{"no_multipliers", [](Solution& s) { s.multipliers.clear(); }, "of 0 dimensions"},
        Wrong{"branched_bound_above_cost",
              [](Solution& s) {
                s.lower_bound = 5.1;
                s.stats.bound_by_branching = true;
              },
              "exceeds the cost"},
        Wrong{"branched_bound_infinite",
              [](Solution& s) {
                s.lower_bound = kInfinity;
                s.stats.bound_by_branching = true;
              },
              "exceeds the cost"},
        Wrong{"branched_bound_nan",
              [](Solution& s) {
                s.lower_bound = kNan;
                s.stats.bound_by_branching = true;
              },
              "lower bound"}),
    [](const auto& tested) { return tested.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Claims,
    WrongSolutions,
    ::testing::Values(
        Wrong{"infeasible_with_a_solution",
              [](Solution& s) { s.status = Status::kInfeasible; },
              "status infeasible is stated, yet there is a solution"},
        Wrong{"infeasible_with_a_bound",
              [](Solution& s) {
                claim_infeasible(s);
                s.lower_bound = 5;
              },
              "yet the lower bound is 5"},
        Wrong{"infeasible_without_a_reason",
              [](Solution& s) {
                claim_infeasible(s);
                s.reason.clear();
              },
              "no reason is given"},
        Wrong{"infeasible_and_proven",
              [](Solution& s) {
                claim_infeasible(s);
                s.proven = true;
              },
              "a cost is stated to be proven"},
        Wrong{"infeasible_with_a_certificate",
              [](Solution& s) {
                claim_infeasible(s);
                s.stats.certificate_bound = 0;
              },
              "certificate 0 is stated"},
        Wrong{"certificate_exaggerated",
              [](Solution& s) { s.stats.certificate_bound = 1e9; },
              "certificate 1000000000 is stated, the multipliers prove"},
        Wrong{"optimal_with_a_gap",
              [](Solution& s) {
                s.lower_bound -= 1;
                s.status = Status::kOptimal;
              },
              "status optimal is stated, yet the lower bound"},
        Wrong{"proven_with_a_gap",
              [](Solution& s) {
                s.lower_bound -= 1;
                s.proven = true;
              },
              "proven, yet the lower bound"},
        Wrong{"optimal_but_not_proven",
              [](Solution& s) { s.status = Status::kOptimal; },
              "status optimal is stated, yet the cost is stated to be not proven"},
        Wrong{"proven_after_a_limit",
              [](Solution& s) { s.proven = s.solutions[0].proven = true; },
              "status iteration_limit is stated, yet the cost is stated to be proven"},
        Wrong{"only_the_first_proven",
              [](Solution& s) { s.solutions[0].proven = true; },
              "solution 1 is stated to be proven, the whole is not"},
        Wrong{"only_the_whole_proven",
              [](Solution& s) {
                s.status = Status::kOptimal;
                s.proven = true;
              },
              "solution 1 is stated to be not proven, yet the whole is"},
        Wrong{"rank_of_another", [](Solution& s) { s.solutions[0].rank = 5; }, "has rank 5"},
        Wrong{"solution_twice",
              [](Solution& s) {
                s.solutions.push_back(s.solutions[0]);
                s.solutions[1].rank = 2;
              },
              "solution 2 has the arcs of solution 1"},
        Wrong{"all_listed_without_proof",
              [](Solution& s) { s.lists_all = true; },
              "solution 1 is not proven, yet the list is stated to have all"},
        Wrong{"better_solution_later",
              [](Solution& s) {
                s.solutions.insert(s.solutions.begin(), {1, 12, false, {{1, 1, 1}, {2, 1, 0}}});
                s.solutions[1].rank = 2;
                s.cost = 12;
              },
              "solution 2 is stated to cost less than the one before"},
        Wrong{"gap_reached_without_a_solution",
              [](Solution& s) {
                s.status = Status::kGapReached;
                s.solutions.clear();
                s.cost = kInfinity;
              },
              "status gap_reached is stated without a solution"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Check, AcceptsAProofToRounding) {
  EXPECT_TRUE(report_after([](Solution& s) {
                s.status = Status::kOptimal;
                s.proven = s.solutions[0].proven = true;
              }).passed());
  const Problem zero = make_problem({1, 1}, {{{1, 1}, 0}}, kInfinity);
  Solution solution = right_solution(zero, *support::brute_force(zero), {{1}, {-1}});
  solution.status = Status::kOptimal;
  solution.proven = solution.solutions[0].proven = true;
  EXPECT_LT(solution.lower_bound, 0) << "rounded down";
  EXPECT_TRUE(check(zero, solution).passed());
}

TEST(Check, FaultsDoNotHideEachOther) {
  const CheckReport report = report_after([](Solution& s) {
    s.solutions[0].arcs.push_back({2, 1, 0});
    s.multipliers.clear();
  });
  EXPECT_FALSE(report.feasible);
  EXPECT_FALSE(report.cost_right);
  EXPECT_FALSE(report.bound_right);
  EXPECT_GE(report.faults.size(), 3u);
}

TEST(Check, SolutionOfAnotherProblemOfTheSameSizesIsRejected) {
  int num_checked = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Problem one = support::random_problem(2 * seed);
    const Problem other = support::random_problem(2 * seed + 1);
    const auto best = support::brute_force(one);
    if (best->arcs.empty()) continue;
    core::Random random(seed);
    const Solution solution = right_solution(one, *best, core::random_multipliers(one, random, 1));
    EXPECT_TRUE(check(one, solution).passed());
    EXPECT_FALSE(check(other, solution).passed());
    ++num_checked;
  }
  EXPECT_GT(num_checked, 250);
}

}  // namespace
}  // namespace nda
