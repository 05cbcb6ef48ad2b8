#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.hpp"

// Bounds on uses, as a user of the program meets them.

namespace nda::cli {
namespace {

using io::TemporaryFolder;
using io::write_file;
using ::testing::HasSubstr;

// data/merged-measurement.nda: both targets take detection 1 at -3 - 1.5, detection 2 is a false
// alarm at 1; u = 3 1 | 0 1 proves it.
const std::string kProblem =
    "p nda 2 2 2 7\nb 2 1 1 2\nb 2 2 1 2\na 1 0 3\na 2 0 3\na 0 1 1\na 0 2 1\n"
    "a 1 1 -3\na 2 1 -1.5\na 2 2 2\n";

Solution right_solution() {
  Solution solution;
  solution.sizes = {2, 2};
  solution.num_arcs = 3;
  solution.status = Status::kOptimal;
  solution.proven = true;
  solution.cost = solution.lower_bound = solution.stats.certificate_bound = -3.5;
  solution.solutions = {{1, -3.5, true, {{1, 1}, {2, 1}}}};
  solution.multipliers = {{3, 1}, {0, 1}};
  return solution;
}

TEST(ManyToOne, GoesThroughConvertAndBack) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda convert a.nda b.nda.gz && nda convert b.nda.gz -");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_EQ(outcome.output, kProblem);
  const Outcome refused = run(folder, "nda convert a.nda a.csv");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.log,
            "nda: a.csv: format csv cannot deal with bounds on uses: index 1 of dimension 2 has "
            "bounds 1..2\n");
  EXPECT_THAT(folder.files(), ::testing::UnorderedElementsAre("a.nda", "b.nda.gz"));
}

TEST(ManyToOne, IsCounted) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda info a.nda");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("\nbounds on uses       2 of 4 indices\n"));
}

TEST(ManyToOne, IsChecked) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  write_solution(right_solution(), folder / "a.json");
  const Outcome right = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(right.code, 0) << right.output;
  EXPECT_THAT(right.output, HasSubstr("bound right         yes\n"));
  Solution wrong = right_solution();
  wrong.solutions[0].arcs.push_back({2, 2});
  write_solution(wrong, folder / "a.json");
  const Outcome denied = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(denied.code, 1);
  EXPECT_THAT(denied.output, HasSubstr("fault: index 2 of dimension 1 is used twice\n"));
}

// Five solutions; in the best, target 2 shares detection 1: arcs (1 1) and (2 1) of it weigh more
// than 1 together.
TEST(ManyToOne, HasMarginals) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda solve a.nda -q --k 5 --marginals -o a.json");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("ranks         5, 5 of them proven\n"));
  EXPECT_THAT(outcome.output,
              HasSubstr("         2         1      0.30749      0.99767  1 1\n"
                        "                                      0.914881  2 1\n"
                        "                                   6.83112e-05  alone\n"));
  const Outcome checked = run(folder, "nda check a.nda a.json");
  EXPECT_EQ(checked.code, 0) << checked.output;
  EXPECT_THAT(checked.output, HasSubstr("marginals right     yes\n"));
}

TEST(ManyToOne, IsComparedByWhatKnowsIt) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda compare a.nda --methods brute-force,greedy,sgts");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("\ngreedy       -3.500000 *"));
  EXPECT_THAT(outcome.output, HasSubstr("\nbrute-force  -3.500000 *    0.0000    -3.500000 *"));
  EXPECT_THAT(outcome.output,
              HasSubstr("skipped    -       index 1 of dimension 2 has bounds 1..2\n"));
}

// -3.5 where both targets take detection 1, -1 where each takes its own.
TEST(ManyToOne, IsRanked) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda solve a.nda -q --k 2 --output a.json");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("\nranks         2, 2 of them proven\n"));
  EXPECT_THAT(outcome.output, HasSubstr("\n         2          -1.000000            2.5 "));
  EXPECT_THAT(run(folder, "nda check a.nda a.json").output, HasSubstr("passed"));
}

}  // namespace
}  // namespace nda::cli
