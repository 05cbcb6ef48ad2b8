#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "cli/command.hpp"
#include "cli/program.hpp"
#include "nda/version.hpp"

namespace nda::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(CommandLine, TellsItsVersion) {
  const Outcome outcome = run({}, "nda --version");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.output, std::string("nda ") + kVersion + "\n");
  EXPECT_EQ(outcome.log, "");
}

TEST(CommandLine, ListsItsCommandsOnce) {
  const Outcome outcome = run({}, "nda --help");
  EXPECT_EQ(outcome.code, 0);
  std::set<std::string> names;
  for (const Command& command : commands()) {
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
    EXPECT_THAT(outcome.output, HasSubstr(std::string("\n  ") + command.name + " "));
  }
}

// The footer comes last, so a help text that ends in an example shows the program's name near its
// end, in a line of its own.
TEST(CommandLine, EndsEveryHelpTextInAWorkedExample) {
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    const Outcome outcome = run({}, std::string("nda ") + command.name + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.log, "");
    const std::size_t example = outcome.output.rfind("\nExample");
    ASSERT_NE(example, std::string::npos);
    EXPECT_THAT(outcome.output.substr(example), HasSubstr(std::string("\n  nda ") + command.name));
  }
}

TEST(CommandLine, RefusesWrongUsageInOneLine) {
  const struct {
    const char* arguments;
    const char* message;
  } kCases[] = {
      {"", "nda: no command given (nda --help lists the commands)\n"},
      {"solvee x", "nda: unknown command 'solvee' (nda --help lists the commands)\n"},
      {"--frobnicate",
       "nda: The following argument was not expected: --frobnicate (nda --help lists the "
       "commands)\n"},
      {"convert a.nda", "nda: output is required (nda convert --help shows the usage)\n"},
      {"convert a.nda b.nda c.nda",
       "nda: The following argument was not expected: c.nda (nda convert --help shows the "
       "usage)\n"},
  };
  for (const auto& wrong : kCases) {
    const Outcome outcome = run({}, std::string("nda ") + wrong.arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(outcome.log, wrong.message);
  }
}

// What of each command writes to standard output.
const std::map<std::string, std::string> kResults = {
    {"solve", "solve a.nda -q"},
    {"options", "options"},
    {"check", "check a.nda a.json"},
    {"info", "info a.nda"},
    {"convert", "convert a.nda -"},
    {"generate", "generate gadgets"},
    {"compare", "compare a.nda --methods greedy --csv a.csv"},
};

// The last line of a text: log and progress may stand before it.
std::string last_line(const std::string& text) {
  if (text.empty()) return text;
  return text.substr(text.rfind('\n', text.size() - 2) + 1);
}

TEST(CommandLine, FailsWhenTheResultsOfACommandGetLost) {
  const io::TemporaryFolder folder;
  io::write_file(folder / "a.nda", "p nda 2 1 1 1\na 1 1 -3\n");
  run(folder, "nda solve a.nda -o a.json");
  for (const Command& command : commands()) {
    SCOPED_TRACE(command.name);
    ASSERT_TRUE(kResults.contains(command.name)) << "add how it is called";
    const std::string call = "nda " + kResults.at(command.name);
    EXPECT_EQ(run(folder, call).code, 0);
    const Outcome full = run(folder, call + " > /dev/full");
    EXPECT_EQ(full.code, 2);
    EXPECT_EQ(last_line(full.log), "nda: standard output: cannot write: No space left on device\n");
    const Outcome closed = run(folder, call + " >&-");
    EXPECT_EQ(closed.code, 2);
    EXPECT_EQ(last_line(closed.log), "nda: standard output: cannot write: Bad file descriptor\n");
  }
  for (const char* call : {"nda solve a.nda --json", "nda solve a.nda -q -o -"}) {
    const Outcome full = run(folder, std::string(call) + " > /dev/full");
    EXPECT_EQ(full.code, 2);
    EXPECT_EQ(full.log, "nda: standard output: cannot write: No space left on device\n");
  }
}

// The first file to be opened would get the number of a closed standard output.
TEST(CommandLine, WritesNothingIntoAFileInPlaceOfAClosedOutput) {
  const io::TemporaryFolder folder;
  io::write_file(folder / "a.nda", "p nda 2 1 1 1\na 1 1 -3\n");
  const std::string call = "nda compare a.nda --methods greedy --csv ";
  run(folder, call + "right.csv");
  run(folder, call + "a.csv >&-");
  EXPECT_EQ(io::contents(folder / "right.csv").substr(0, 100),
            io::contents(folder / "a.csv").substr(0, 100));
  EXPECT_THAT(io::contents(folder / "a.csv"), Not(HasSubstr("3 dimensions")));
}

TEST(CommandLine, ReportsAFullDiskAndAClosedPipe) {
  const Outcome full = run({}, "nda --help > /dev/full");
  EXPECT_EQ(full.code, 2);
  EXPECT_EQ(full.log, "nda: standard output: cannot write: No space left on device\n");
  const Outcome closed = run({}, "nda --help >&-");
  EXPECT_EQ(closed.code, 2);
  EXPECT_EQ(closed.log, "nda: standard output: cannot write: Bad file descriptor\n");
  const Outcome broken = run({}, "{ sleep 0.2; nda --help; echo code $? >&2; } | true");
  EXPECT_EQ(broken.log, "nda: standard output: cannot write: Broken pipe\ncode 2\n");
}

}  // namespace
}  // namespace nda::cli
