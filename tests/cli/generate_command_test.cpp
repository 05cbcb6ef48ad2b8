#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/program.hpp"

namespace nda::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr const char* kFamilies[] = {
    "poore-5.1", "poore-5.3", "tracking", "groups", "six-scan", "map3", "planted", "gadgets"};

TEST(GenerateCommand, WritesEveryFamilyWithTheCommandThatMakesItAgain) {
  const io::TemporaryFolder folder;
  for (const char* family : kFamilies) {
    SCOPED_TRACE(family);
    const Outcome first = run(folder, std::string("nda generate ") + family + " --seed 3");
    EXPECT_EQ(first.code, 0);
    EXPECT_THAT(first.output, StartsWith("c nda generate "));
    EXPECT_THAT(first.log, HasSubstr(" arcs, "));
    const std::string again = first.output.substr(2, first.output.find('\n') - 2);
    EXPECT_EQ(run(folder, again).output, first.output);
  }
}

TEST(GenerateCommand, EndsTheHelpOfEveryFamilyInAWorkedExample) {
  for (const char* family : kFamilies) {
    SCOPED_TRACE(family);
    const Outcome outcome = run({}, std::string("nda generate ") + family + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.output, HasSubstr(std::string("Example:\n  nda generate ") + family));
  }
}

TEST(GenerateCommand, LetsOptionsOverrideThePreset) {
  const Outcome outcome =
      run({}, "nda generate tracking --preset hard6 --targets 12 --cap 20 | head -1");
  EXPECT_THAT(outcome.output, HasSubstr(" --scans 6 --targets 12 --side 1500 "));
  EXPECT_THAT(outcome.output, HasSubstr(" --cap 20 "));
}

TEST(GenerateCommand, CompressesByName) {
  const io::TemporaryFolder folder;
  const Outcome outcome = run(folder,
                              "nda generate map3 --size 3 -o a.nda && "
                              "nda generate map3 --size 3 -o a.nda.gz && gunzip -c a.nda.gz | "
                              "cmp - a.nda");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
}

TEST(GenerateCommand, RefusesWhatIsWrongInOneLine) {
  const struct {
    const char* arguments;
    const char* message;
  } kCases[] = {
      {"planted --miss-rate 2", "miss_rate is 2, must be in [0, 0.9]"},
      {"tracking --preset giant", "no tracking preset is called giant"},
      {"planted --singletons dear", "--singletons"},
      {"poore-5.1 --arcs many", "--arcs"},
      {"poore-5.1 --arcs -1", "--arcs: '-1' given, it must be a number, 0 or more"},
      {"map3 --seed -1", "--seed: '-1' given, it must be a number, 0 or more"},
      {"tracking --seed -1", "--seed: '-1' given, it must be a number, 0 or more"},
      {"", "nda generate --help"},
      {"poore", "nda generate --help"},
      {"map3 --output /nowhere/a.nda", "/nowhere/a.nda"},
  };
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.arguments);
    const Outcome outcome = run({}, std::string("nda generate ") + wrong.arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_THAT(outcome.log, HasSubstr(wrong.message));
    EXPECT_EQ(std::count(outcome.log.begin(), outcome.log.end(), '\n'), 1);
  }
}

}  // namespace
}  // namespace nda::cli
