#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "cli/program.hpp"
#include "nda/options.hpp"

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

// support::crossing_tracks(): the best is -8, greedy ends at -7.
const std::string kCrossing = "p nda 3 2 2 2 4\na 1 1 1 -4\na 1 1 2 -5\na 2 2 1 -2\na 2 2 2 -4\n";

// Times and the blanks that depend on their width.
std::string without_times(const std::string& text) {
  return std::regex_replace(text, std::regex(" +[0-9]+\\.[0-9]{4}(?=  [a-z])"), "  T");
}

// A search path of its own, so that what is installed does not matter: commands of the shell by
// full name, fake solvers in ./bin.
void add_program(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  std::filesystem::create_directory(folder / "bin");
  write_file(folder / ("bin/" + name), "#!/bin/sh\n" + text);
  std::filesystem::permissions(folder / ("bin/" + name), std::filesystem::perms::owner_all);
}

TEST(CompareCommand, ShowsPresetsOnEveryFamily) {
  const Outcome outcome = run({}, "nda compare --presets --time-limit 0.02");
  EXPECT_EQ(outcome.code, 0) << outcome.output;
  for (const char* family : {"poore-5.1:", "poore-5.3:", "map3:", "planted:", "six-scan:"})
    EXPECT_THAT(outcome.output, HasSubstr(family));
  for (const PresetInfo& line : presets()) {
    if (line.is_paper) {
      EXPECT_THAT(outcome.output, HasSubstr(line.name));
    }
  }
  EXPECT_THAT(outcome.output, HasSubstr("8 files"));
}

TEST(CompareCommand, PrintsOneTablePerFileAndTheirSummary) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  write_file(folder / "b.nda", "p nda 2 1 1 1\na 1 1 -3\n");
  const Outcome outcome =
      run(folder, "nda compare a.nda b.nda --methods greedy,default,brute-force");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  const std::size_t summary = outcome.output.find("2 files\n");
  ASSERT_NE(summary, std::string::npos) << outcome.output;
  EXPECT_EQ(without_times(outcome.output.substr(0, summary)),
            R"(a.nda: 3 dimensions, 6 indices, 4 arcs
method            cost    excess %  lower bound     gap %  seconds  status     proven
default      -8.000000 *    0.0000    -8.000000 *  0.0000  T  optimal    yes
greedy       -7.000000     12.5000            -         -  T  heuristic  -
brute-force  -8.000000 *    0.0000    -8.000000 *  0.0000  T  optimal    yes

b.nda: 2 dimensions, 2 indices, 1 arcs
method            cost    excess %  lower bound     gap %  seconds  status     proven
default      -3.000000 *    0.0000    -3.000000 *  0.0000  T  optimal    yes
greedy       -3.000000 *    0.0000            -         -  T  heuristic  -
brute-force  -3.000000 *    0.0000    -3.000000 *  0.0000  T  optimal    yes

)");
  EXPECT_THAT(outcome.output.substr(summary),
              HasSubstr("\ngreedy           2       2     1       0"));
  EXPECT_THAT(outcome.log,
              AllOf(HasSubstr("a.nda: default ... optimal"), HasSubstr("b.nda: greedy")));
}

TEST(CompareCommand, WritesAllFiguresToACsvFile) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  const Outcome outcome = run(folder, "nda compare a.nda --methods greedy,sgts --csv t.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  const std::string csv = contents(folder / "t.csv");
  EXPECT_THAT(csv, StartsWith("file,dimensions,indices,arcs,method,"));
  EXPECT_THAT(csv, HasSubstr("\na.nda,3,6,4,greedy,baseline,heuristic,no,-7,,,"));
  EXPECT_THAT(csv, HasSubstr("\na.nda,3,6,4,sgts,baseline,heuristic,no,-"));
}

TEST(CompareCommand, NamesBothWhoContradictEachOther) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  add_program(folder, "cbc", "echo 'Infeasible - objective value 0.0' > solution\n");
  const Outcome outcome = run(folder, "PATH=$PWD/bin; nda compare a.nda --methods default,cbc");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.output,
              HasSubstr("\nINCONSISTENT: cbc claims that there is no solution, default has one of "
                        "cost -8\n"));
}

TEST(CompareCommand, SaysWhichPackageBringsAMissingSolver) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  const Outcome outcome = run(folder, "PATH=/none; nda compare a.nda --methods greedy,cbc,glpk");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("\ncbc is not installed (Debian package: coinor-cbc)\n"),
                    HasSubstr("\nglpk is not installed (Debian package: glpk-utils)\n"),
                    Not(HasSubstr("\ncbc  "))));
}

TEST(CompareCommand, LeavesNoTemporaryFilesNotEvenWhenInterrupted) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  std::filesystem::create_directory(folder / "tmp");
  add_program(folder, "cbc", ": > ../../started\nexec /bin/sleep 60\n");
  const Outcome outcome = run(folder,
                              "export TMPDIR=$PWD/tmp; "
                              "PATH=$PWD/bin:$PATH '" NDA_PROGRAM
                              "' compare a.nda --methods cbc,greedy & "
                              "until test -e started; do sleep 0.01; done; kill -TERM $!; wait $!");
  EXPECT_EQ(outcome.code, 3) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("interrupted"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

TEST(CompareCommand, KillsASolverThatIgnoresItsLimit) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  add_program(folder, "cbc", "/bin/sleep 60\n");
  const Outcome outcome =
      run(folder, "PATH=$PWD/bin; nda compare a.nda --methods cbc --time-limit 0.1");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("  killed  "));
}

TEST(CompareCommand, TakesFilesAfterTheMethods) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  write_file(folder / "b.nda", kCrossing);
  const Outcome outcome = run(folder, "nda compare --methods greedy,sgts a.nda b.nda");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("2 files\n"));
}

TEST(CompareCommand, NamesWhatIsWrongInOneLine) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kCrossing);
  const struct {
    const char* arguments;
    const char* message;
  } kCases[] = {
      {"a.nda none.nda", "nda: none.nda: cannot open"},
      {"a.nda --methods magic", "nda: method 'magic' is not known; there are default,"},
      {"a.nda --methods greedy --csv /no/such/t.csv", "nda: /no/such/t.csv: cannot be written"},
      {"a.nda --csv ./a.nda", "nda: ./a.nda: cannot write: it is the problem itself"},
      {"a.nda --csv ''", "nda: --csv: '' given, it must name a file ("},
      {"a.nda --time-limit 0", "nda: --time-limit"},
      {"a.nda --time-limit nan", "nda: --time-limit: option time_limit_s is 'nan'"},
  };
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.arguments);
    const Outcome outcome = run(folder, std::string("nda compare ") + wrong.arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.output, IsEmpty());
    EXPECT_THAT(outcome.log, StartsWith(wrong.message));
    EXPECT_EQ(std::count(outcome.log.begin(), outcome.log.end(), '\n'), 1);
  }
}

}  // namespace
}  // namespace nda::cli
