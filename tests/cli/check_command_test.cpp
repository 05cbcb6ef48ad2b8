#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "cli/program.hpp"

namespace nda::cli {
namespace {

using io::TemporaryFolder;
using io::write_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Two arcs that exclude each other: the optimum takes the cheaper one, and the multipliers
// u[1][1] = -3, all others 0, prove it: -3 + min(0, -3 + 3) + min(0, -2 + 3) + singletons 0.
constexpr const char* kProblem = "p nda 2 1 2 2\na 1 1 -3\na 1 2 -2\n";

Solution right_solution() {
  Solution solution;
  solution.sizes = {1, 2};
  solution.num_arcs = 2;
  solution.num_components = 1;
  solution.status = Status::kOptimal;
  solution.proven = true;
  solution.cost = -3;
  solution.lower_bound = -3;
  solution.solutions = {{1, -3, true, {{1, 1}}}};
  solution.multipliers = {{-3}, {0, 0}};
  solution.stats.certificate_bound = -3;
  return solution;
}

TEST(CheckCommand, PassesARightSolution) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  write_solution(right_solution(), folder / "a.json");
  const Outcome outcome = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("passed\n"));
}

TEST(CheckCommand, FailsAWrongCostAndAnExaggeratedBound) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  Solution wrong_cost = right_solution();
  wrong_cost.cost = wrong_cost.solutions[0].cost = -4;
  Solution wrong_bound = right_solution();
  wrong_bound.multipliers = {{-2}, {-5, 0}};
  Solution wrong_arc = right_solution();
  wrong_arc.solutions[0].arcs = {{1, 1}, {1, 2}};
  for (const Solution& wrong : {wrong_cost, wrong_bound, wrong_arc}) {
    write_solution(wrong, folder / "a.json");
    const Outcome outcome = run(folder, "nda check a.nda a.json");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.output, HasSubstr("fault: "));
    EXPECT_THAT(outcome.output, HasSubstr("FAILED\n"));
  }
}

TEST(CheckCommand, SaysWhatCannotBeChecked) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  Solution branched = right_solution();
  branched.multipliers = {{0}, {0, 0}};
  branched.stats.certificate_bound = -5;
  branched.stats.bound_by_branching = true;
  write_solution(branched, folder / "a.json");
  const Outcome outcome = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  EXPECT_THAT(outcome.output,
              HasSubstr("bound right         by branching: not checkable without a whole proof\n"));

  write_file(folder / "b.nda", "p nda 2 2 1 4\na 1 1 1\na 2 1 1\na 1 0 inf\na 2 0 inf\n");
  run(folder, "nda solve b.nda -q -o b.json");
  const Outcome infeasible = run(folder, "nda check b.nda b.json");
  EXPECT_EQ(infeasible.code, 0) << infeasible.output;
  EXPECT_THAT(infeasible.output, HasSubstr("feasible            no solution\n"));
  EXPECT_THAT(infeasible.output,
              HasSubstr("bound right         infeasible by branching: not checkable\n"));
}

TEST(CheckCommand, FollowsAProof) {
  const TemporaryFolder folder;
  // Three arcs, pairwise in conflict: optimum -1.25, multipliers prove -1.75.
  write_file(folder / "a.nda", "p nda 3 1 1 1 3\na 0 1 1 -1.25\na 1 0 1 -1.25\na 1 1 0 -1\n");
  const Outcome solved = run(folder, "nda solve a.nda -q -o a.json --proof a.proof");
  EXPECT_EQ(solved.code, 0) << solved.log;
  EXPECT_EQ(run(folder, "nda solve a.nda -q --proof -").code, 2) << "the summary is there already";
  EXPECT_EQ(run(folder, "nda solve a.nda -q -o /dev/null --proof /dev/null").code, 0);
  const Outcome right = run(folder, "nda check a.nda a.json --proof a.proof");
  EXPECT_EQ(right.code, 0) << right.output;
  EXPECT_THAT(right.output, HasSubstr("bound right         yes\n"));
  EXPECT_THAT(right.output, HasSubstr("proof's bound       -1.25"));
  EXPECT_THAT(right.output, HasSubstr(" s checking, without reading\npassed\n"));

  write_file(folder / "bad.proof",
             "p nda-proof 3 1 1 1 3 0 1\npart 3 1 1 1 2 1 3 1\nbound 0 0\nend 0\n");
  const std::string digest = run(folder, "nda check a.nda a.json --proof bad.proof").log;
  const std::size_t at = digest.find("its digest is ");
  ASSERT_NE(at, std::string::npos) << digest;
  write_file(folder / "bad.proof",
             "p nda-proof 3 1 1 1 3 0 1\npart 3 1 1 1 2 1 3 1\nbound 0 0\nend " +
                 digest.substr(at + 14, digest.find(',', at) - at - 14) + "\n");
  const Outcome wrong = run(folder, "nda check a.nda a.json --proof bad.proof");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_THAT(wrong.output, HasSubstr("fault: lower bound -1.25 is stated, the multipliers prove"));
  write_file(folder / "cut.proof", "p nda-proof 3 1 1 1 3 0 1\npart 3 1 1 1 2 1 3 1\n");
  EXPECT_THAT(run(folder, "nda check a.nda a.json --proof cut.proof").log,
              HasSubstr("nda: cut.proof: line 3: expected a step"));
}

// An old proof would be taken for that of the new solution.
TEST(CheckCommand, FindsNoOldProofWhereThereIsNoNewOne) {
  const TemporaryFolder folder;
  const struct {
    const char* problem;
    int code;
  } kCases[] = {
      {"p nda 2 2 1 4\na 1 1 1\na 2 1 1\na 1 0 inf\na 2 0 inf\n", 1},  // infeasible
      {"p nda 2 1 1 1\na 1 1 -1e300\n", 0},                            // precision lost
      {"p nda 2 2 1 2\nb 2 1 0 2\na 1 1 -3\na 2 1 -1\n", 2},           // bounds on uses
  };
  for (const auto& has_none : kCases) {
    SCOPED_TRACE(has_none.problem);
    write_file(folder / "a.nda", has_none.problem);
    write_file(folder / "a.proof", "of something else");
    const std::string solve = "nda solve a.nda -q --proof a.proof";
    const std::string none = "nda: a.proof: not written, there is no proof";
    const Outcome first = run(folder, solve);
    EXPECT_EQ(first.code, has_none.code) << first.log;
    EXPECT_THAT(first.log, StartsWith(none + "; the old one is removed\n"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.proof"));
    EXPECT_THAT(run(folder, solve).log, StartsWith(none + "\n"));
  }
}

// Branching on indices is written down, as branch and cut is; relaxations of three sets are not.
TEST(CheckCommand, FollowsEveryKindOfBranching) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, "nda generate poore-5.1 --arcs 260 --seed 2 -o a.nda").code, 0);
  const std::string solve = "nda solve a.nda -q -o a.json --proof a.proof --method ";
  const std::string check = "nda check a.nda a.json --proof a.proof";
  for (const char* method : {"exact", "auto"}) {
    const Outcome solved = run(folder, solve + method);
    EXPECT_THAT(solved.output, HasSubstr("(proven optimal)"));
    EXPECT_EQ(solved.log, "");
    EXPECT_EQ(io::contents(folder / "a.proof").find("\nsplit ") != std::string::npos,
              method == std::string("exact"));
    EXPECT_EQ(run(folder, check).code, 0);
  }
}

// Weights 1, 1/e and 1/e^3 of 1.417667: 0.705385 and so on.
TEST(CheckCommand, FailsMarginalsThatTheSolutionsDoNotHave) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  run(folder, "nda solve a.nda -q --k 3 --marginals -o a.json");
  const Outcome right = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(right.code, 0) << right.output;
  EXPECT_THAT(right.output, HasSubstr("marginals right     yes\n"));

  const std::string text = io::contents(folder / "a.json");
  const std::size_t place = text.find("{\"arc\":[1,1],\"weight\":0.705384");
  ASSERT_NE(place, std::string::npos) << text;
  std::string wrong = text;
  wrong.replace(wrong.find("0.705384", place), 8, "0.705394");
  write_file(folder / "a.json", wrong);
  const Outcome outcome = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output, HasSubstr("marginals right     no\n"));
  EXPECT_THAT(outcome.output,
              HasSubstr("fault: marginals: weight of arc (1 1) is stated to be 0.705394"));
}

TEST(CheckCommand, NamesTheFileItCannotRead) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  write_file(folder / "a.json", "{");
  const Outcome outcome = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.log, HasSubstr("nda: a.json: invalid JSON: parse error at line 1, column 2"));
}

}  // namespace
}  // namespace nda::cli
