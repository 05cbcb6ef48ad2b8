#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.hpp"
#include "core/option_table.hpp"

namespace nda::cli {
namespace {

using io::contents;
using io::TemporaryFolder;
using io::write_file;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// support::odd_cycle(): three arcs that exclude each other in pairs, the best takes one.
const std::string kProblem = "p nda 3 1 1 1 3\na 1 1 0 -1\na 1 0 1 -1\na 0 1 1 -1\n";

// Two rows that need the same column.
const std::string kInfeasible = "p nda 2 2 1 4\na 1 1 3\na 2 1 4\na 1 0 inf\na 2 0 inf\n";

// Partial branch and bound is a way to one good solution, too.
TEST(SolveCommand, RanksByAlignmentsForOneSolution) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, "nda generate six-scan -o six.nda").code, 0);
  const auto cost = [&](const std::string& preset) {
    const Outcome outcome = run(folder, "nda solve six.nda -q --json --preset " + preset);
    return solution_from_json(outcome.output).cost;
  };
  EXPECT_LT(cost("partial-bnb"), cost("poore-1995"));
}

TEST(SolveCommand, PrintsASummaryAndWritesTheSolution) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda solve a.nda -o a.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("status        optimal\n"), HasSubstr("cost          -")));
  EXPECT_THAT(outcome.log, HasSubstr("lower bound"));
  EXPECT_EQ(run(folder, "nda check a.nda a.json").code, 0);
}

// Four solutions: one arc each, or none.
TEST(SolveCommand, RanksSolutions) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome outcome = run(folder, "nda solve a.nda --k 9 -o a.json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("ranks         4, 4 of them proven\n"),
                    HasSubstr("         4           0.000000              1        0        1\n")));
  EXPECT_EQ(run(folder, "nda check a.nda a.json").code, 0);
  EXPECT_EQ(run(folder, "nda solve a.nda --k 0").code, 2);
}

// Ranks without proof are no sign of a limit where no way proves them.
TEST(SolveCommand, BlamesNoLimitForRanksByAlignments) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "p nda 2 2 2 4\na 1 1 -1\na 2 2 -2\na 1 2 -1\na 2 1 -1\n");
  const Outcome outcome = run(folder, "nda solve a.nda --k 2 --set ranking.method=alignments");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("ranks         2, 1 of them proven\n"));
}

// The four of RanksSolutions weigh 1, 1, 1 and 1/e, of 3.367879.
TEST(SolveCommand, WeighsWhatTheRanksHave) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome all = run(folder, "nda solve a.nda -q --k 9 --marginals -o a.json");
  EXPECT_EQ(all.code, 0);
  EXPECT_THAT(all.output,
              AllOf(HasSubstr("         4           0.000000              1        0        1"
                              "     0.109232\n"),
                    HasSubstr("\nmarginals     exact: there is no solution but these\n"
                              "ambiguous     3 of 3 indices; 3 of 3 arcs are in doubt\ntook "),
                    HasSubstr("\n         1         1      1.08705     0.406155  alone\n"),
                    HasSubstr("\n  0.296923  0 1 1\n")));
  EXPECT_THAT(contents(folder / "a.json"), HasSubstr("\n  \"marginals\": {\n"));
  EXPECT_THAT(run(folder, "nda check a.nda a.json").output, HasSubstr("marginals right     yes\n"));

  const Outcome two = run(folder, "nda solve a.nda -q --k 2 --marginals --cost-per-nat 3");
  EXPECT_THAT(
      two.output,
      HasSubstr("\nmarginals     if the truth is one of these ranks; 2 of 2 proven, the last "
                "weighs 0.5\n"));
  EXPECT_THAT(run(folder, "nda solve a.nda --k 4 --marginals --json --cost-per-nat 3").output,
              HasSubstr("    \"cost_per_nat\": 3.0,\n"));
  const Outcome one = run(folder, "nda solve a.nda -q --k 1 --marginals");
  EXPECT_THAT(one.output, HasSubstr("ambiguous     0 of 3 indices; 0 of 1 arcs are in doubt\n"));
  EXPECT_THAT(run(folder, "nda solve a.nda -q --k 9").output, Not(HasSubstr("weight")));
}

TEST(SolveCommand, HasNoMarginalsOfNoSolution) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kInfeasible);
  const Outcome outcome = run(folder, "nda solve a.nda -q --k 3 --marginals -o a.json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output, Not(HasSubstr("marginals")));
  EXPECT_EQ(run(folder, "nda check a.nda a.json").code, 0);
}

TEST(SolveCommand, EndsItsLogWithTheClosedGap) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "p nda 3 2 2 1 3\na 1 1 1 -5\na 1 2 1 -6\na 2 2 0 -4\n");
  const Outcome outcome = run(folder, "nda solve a.nda");
  EXPECT_THAT(outcome.log, HasSubstr("          -9.000000          -9.000000     0.0000 "));
}

TEST(SolveCommand, TellsWhatReductionsDidOnDemand) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "p nda 3 2 2 1 3\na 1 1 1 -7\na 1 2 1 -3\na 2 2 0 -4\n");
  EXPECT_THAT(run(folder, "nda solve a.nda").output, Not(HasSubstr("reductions")));
  EXPECT_THAT(run(folder, "nda solve a.nda -v").output,
              AllOf(HasSubstr("  reductions\n"),
                    HasSubstr("reductions    settled 1 of 1 components, 1 tried\n"),
                    HasSubstr("2 arcs that outweigh all they exclude, which dropped 1 more\n")));
  EXPECT_THAT(run(folder, "nda solve a.nda -v --set search.reductions=none").output,
              AllOf(HasSubstr("reductions    settled 0 of 1 components, 0 tried\n"),
                    HasSubstr("\nfixing        left 3 of 3 arcs at first and 3 in the end, ")));
}

// One arc outweighs its rival, which opens nothing.
TEST(SolveCommand, TellsOnDemandWhatWasInVain) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda",
             "p nda 3 2 2 2 5\na 2 2 0 -10\na 0 2 1 -1\na 1 1 0 -1\na 1 0 1 -1\na 0 1 1 -1\n");
  EXPECT_THAT(
      run(folder, "nda solve a.nda -v").output,
      HasSubstr("\nreductions    settled 0 of 1 components, 1 tried\n"
                "in vain       left 3 of 5 arcs of 1 components, which were solved whole\n"
                "              1 arcs that outweigh all they exclude, which dropped 1 more\n"
                "fixing        left 5 of 5 arcs at first and "));
}

TEST(SolveCommand, TellsOnDemandWhatSearchesFixed) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, "nda generate gadgets -o a.nda").code, 0);
  const Outcome outcome = run(folder, "nda solve a.nda -v -o a.json");
  const FixingYield yield = read_solution(folder / "a.json").stats.searches;
  EXPECT_GT(yield.splits, 0u);
  EXPECT_THAT(
      outcome.output,
      HasSubstr("\nsearches      dropped " + std::to_string(yield.dropped) + " arcs and took " +
                std::to_string(yield.taken) + "; " + std::to_string(yield.splits) +
                " nodes fell into " + std::to_string(yield.parts) + " parts\n"));
}

// Everything is settled before it is split: both arcs of the best solution, and the third against
// it.
TEST(SolveCommand, TellsOnDemandWhatAHotStartFixed) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "p nda 3 2 2 1 3\na 1 1 1 -7\na 1 2 1 -3\na 2 2 0 -4\n");
  EXPECT_THAT(run(folder, "nda solve a.nda -v --save-warm-start a.warm").output,
              Not(HasSubstr("exchange")));
  EXPECT_THAT(
      run(folder, "nda solve a.nda -v --warm-start a.warm").output,
      AllOf(HasSubstr("components    0, 3 of 3 arcs after the cost shift\n"),
            HasSubstr("\nexchange      kept 2 and excluded 1 of 3 arcs in 1 rounds of a hot start\n"
                      "fixing        left 0 of 0 arcs")));
}

TEST(SolveCommand, PrintsTheJsonOnceAndNothingElse) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  for (const char* flags : {"--json", "-o -", "--json -o -"}) {
    SCOPED_TRACE(flags);
    const Outcome outcome = run(folder, std::string("nda solve a.nda ") + flags);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.log, "");
    EXPECT_NO_THROW(solution_from_json(outcome.output)) << outcome.output;
  }
}

TEST(SolveCommand, SaysOfAnInfeasibleProblemWhyAndNoBound) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kInfeasible);
  const Outcome outcome = run(folder, "nda solve a.nda -q -v -o a.json");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("status        infeasible\nreason        indices 1, 2 of dimension "),
                    HasSubstr(" infeasible                inf                inf  assignment\n"),
                    Not(HasSubstr("lower bound   "))));
  EXPECT_THAT(contents(folder / "a.json"),
              AllOf(HasSubstr("\"lower_bound\": \"inf\","),
                    HasSubstr("\"multipliers\": [],"),
                    HasSubstr("\"certificate_bound\":\"-inf\",\"bound_by_branching\":true")));
  EXPECT_EQ(run(folder, "nda check a.nda a.json").code, 0);
}

TEST(SolveCommand, SetsEveryOptionOfTheListToItsDefault) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const Outcome list = run(folder, "nda options");
  std::string command = "nda solve a.nda -q";
  for (const core::OptionRow& row : core::option_table()) {
    const std::string setting = row.name + "=" + row.text(Options());
    EXPECT_THAT("\n" + list.output, HasSubstr("\n" + setting + "\n    " + row.meaning + ": "));
    command += " --set " + setting;
  }
  EXPECT_EQ(run(folder, command).code, 0);
}

TEST(SolveCommand, LetsSettingsOverrideFlagsAndFlagsThePreset) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const std::string exact = "nda solve a.nda -qv --method exact";
  EXPECT_THAT(run(folder, exact + " --set method=relaxation --set branch.exact_arcs=0").output,
              HasSubstr("  relaxation\n"));
  EXPECT_THAT(run(folder, exact).output, HasSubstr("  enumeration\n"));
  EXPECT_EQ(run(folder, "nda solve a.nda --preset realtime --time-limit inf").code, 0);
}

TEST(OptionsCommand, ShowsThePresets) {
  EXPECT_THAT(run({}, "nda options").output, HasSubstr("\ntime_limit_s=inf\n"));
  EXPECT_THAT(run({}, "nda options --preset realtime").output, HasSubstr("\ntime_limit_s=0.05\n"));
}

TEST(SolveCommand, TakesTheFileAfterASetting) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  EXPECT_EQ(run(folder, "nda solve --set seed=2 a.nda").code, 0);
}

TEST(SolveCommand, NamesWhatIsWrongInOneShortLine) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  const struct {
    const char* arguments;
    const char* message;
  } kCases[] = {
      {"none", "nda: none: cannot open: No such file or directory\n"},
      {".", "nda: .: cannot read: Is a directory\n"},
      {"a.nda --time-limit nan",
       "nda: --time-limit: option time_limit_s is 'nan', it must be a number above 0 ("},
      {"a.nda --gap nan",
       "nda: --gap: option relative_gap is 'nan', it must be a number, 0 or more ("},
      {"a.nda --gap -1", "nda: --gap: option relative_gap is '-1'"},
      {"a.nda --log-interval nan",
       "nda: --log-interval: 'nan' given, it must be a number, 0 or more ("},
      {"a.nda --seed -1",
       "nda: --seed: option seed is '-1', it must be a whole number, 0 or more ("},
      {"a.nda --threads 1000000",
       "nda: --threads: option num_threads is '1000000', it must be a whole number from 0 to 1024"},
      {"a.nda --threads many", "nda: --threads: option num_threads is 'many'"},
      {"a.nda --set seed", "nda: --set: expected NAME=VALUE, found 'seed'"},
      {"a.nda --set magic=1", "nda: --set: option 'magic' is not known"},
      {"a.nda --set relaxation.dual_method=magic",
       "nda: --set: option relaxation.dual_method is 'magic', it must be bundle, subgradient, "
       "volume or coordinate"},
      {"a.nda --method magic",
       "nda: method 'magic' is not known; there are auto, relaxation or exact, and for the dual "
       "bundle, subgradient, volume or coordinate\n"},
      {"a.nda --preset magic", "nda: preset 'magic' is not known"},
      {"a.nda --warm-start a.json --keep 1", "nda: --keep requires --shift"},
      {"a.nda --warm-start a.json --shift 3000000000",
       "nda: --shift: '3000000000' given, it must be a whole number, 0 or more, below 2^31 ("},
      {"a.nda --warm-start a.json --shift 1 --keep -1",
       "nda: --keep: '-1' given, it must be a whole number, 0 or more, below 2^31 ("},
      {"a.nda --k 0", "nda: --k: '0' given, it must be a whole number, 1 or more, below 2^64 ("},
      {"a.nda --marginals", "nda: --marginals requires --k ("},
      {"a.nda --k 2 --cost-per-nat 2", "nda: --cost-per-nat requires --marginals ("},
      {"a.nda --k 2 --marginals --cost-per-nat 0",
       "nda: --cost-per-nat: '0' given, it must be a finite number above 0 ("},
      {"a.nda --k 2 --marginals --cost-per-nat inf",
       "nda: --cost-per-nat: 'inf' given, it must be a finite number above 0 ("},
      {"a.nda -o none/a.json", "nda: none/a.json: cannot write: there is no folder none\n"},
      {"a.nda -o .", "nda: .: cannot write: Is a directory\n"},
      {"a.nda -o ''", "nda: --output: '' given, it must name a file ("},
      {"a.nda --proof ''", "nda: --proof: '' given, it must name a file ("},
      {"a.nda -o b --proof ./b", "nda: ./b: cannot write: the other output is the same file\n"},
      {"a.nda -o - --proof -", "nda: --proof needs the name of a file, found '-'\n"},
      {"a.nda -o ./a.nda", "nda: ./a.nda: cannot write: it is the problem itself\n"},
  };
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.arguments);
    const Outcome outcome = run(folder, std::string("nda solve ") + wrong.arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.output, IsEmpty());
    EXPECT_THAT(outcome.log, StartsWith(wrong.message));
    EXPECT_LT(outcome.log.size(), 250u);
    EXPECT_EQ(std::count(outcome.log.begin(), outcome.log.end(), '\n'), 1);
  }
}

// Windows of one scenario, one scan apart.
TEST(SolveCommand, StartsFromTheLastWindow) {
  const TemporaryFolder folder;
  const std::string generate = "nda generate tracking --scenario-scans 6 --first-scan ";
  ASSERT_EQ(run(folder, generate + "0 -o a.nda && " + generate + "1 -o b.nda").code, 0);
  ASSERT_EQ(run(folder, "nda solve a.nda --save-warm-start a.warm").code, 0);
  const std::string solve = "nda solve b.nda --warm-start a.warm --output b.json";
  for (const char* moved : {"",
                            " --shift 1",
                            " --shift 1 --keep 1",
                            " --shift 1 --keep 0",
                            " --shift 0",
                            " --shift 9",
                            " --shift 2147483647 --keep 2147483647"}) {
    const Outcome outcome = run(folder, solve + moved);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("(proven optimal)"));
    EXPECT_EQ(run(folder, "nda check b.nda b.json").code, 0);
  }
}

TEST(SolveCommand, SaysWhereItStartsCold) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  write_file(folder / "b.nda", "p nda 3 1 1 1 3\na 1 1 0 -1\na 1 0 1 -1\na 1 0 0 inf\n");
  ASSERT_EQ(run(folder, "nda solve a.nda --save-warm-start a.warm").code, 0);
  const std::string warm = " --warm-start a.warm";
  const auto log = [&](const std::string& file, const std::string& how) {
    return run(folder, "nda solve --quiet " + file + warm + how).log;
  };
  EXPECT_EQ(log("a.nda", ""), "");
  EXPECT_EQ(log("a.nda", " --proof a.proof"), "nda: a.warm: not used, a proof is asked for\n");
  EXPECT_EQ(log("a.nda", " --method relaxation"),
            "nda: a.warm: not used, relaxation alone starts at multipliers 0\n");
  EXPECT_EQ(log("b.nda", ""), "nda: a.warm: not used, a singleton is forbidden\n");
}

TEST(SolveCommand, RefusesAWarmStartThatIsNone) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kProblem);
  write_file(folder / "a.warm", R"({"format": "nda-warm-start", "version": 1, "multipliers": 1})");
  const Outcome bad = run(folder, "nda solve a.nda --warm-start a.warm");
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.log, HasSubstr("a.warm: multipliers: expected an array, found"));
  EXPECT_EQ(run(folder, "nda solve a.nda --warm-start missing").code, 2);
  EXPECT_EQ(run(folder, "nda solve a.nda --shift 1").code, 2);
  EXPECT_EQ(run(folder, "nda solve a.nda --save-warm-start a.nda").code, 2);
  const Outcome ranked = run(folder, "nda solve a.nda --k 2 --warm-start a.warm");
  EXPECT_EQ(ranked.code, 2);
  EXPECT_THAT(ranked.log, HasSubstr("--warm-start is for one solution, --k is 2"));
}

}  // namespace
}  // namespace nda::cli
