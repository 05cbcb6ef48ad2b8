#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "cli/command.hpp"
#include "cli/program.hpp"
#include "nda/version.hpp"

namespace nda::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

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
