#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cli/families.hpp"
#include "cli/program.hpp"
#include "support/build_kind.hpp"

namespace nda::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(GenerateCommand, WritesEveryFamilyWithTheCommandThatMakesItAgain) {
  const io::TemporaryFolder folder;
  for (const std::string& family : family_names()) {
    SCOPED_TRACE(family);
    const Outcome first = run(folder, "nda generate " + family + " --seed 3");
    EXPECT_EQ(first.code, 0);
    EXPECT_THAT(first.output, StartsWith("c nda generate "));
    EXPECT_THAT(first.log, HasSubstr(" arcs, "));
    const std::string again = first.output.substr(2, first.output.find('\n') - 2);
    EXPECT_EQ(run(folder, again).output, first.output);
  }
}

TEST(GenerateCommand, EndsTheHelpOfEveryFamilyInAWorkedExample) {
  for (const std::string& family : family_names()) {
    SCOPED_TRACE(family);
    const Outcome outcome = run({}, "nda generate " + family + " --help");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("Example:\n  nda generate " + family));
  }
}

TEST(GenerateCommand, TakesTheLimitsThatItsHelpLists) {
  EXPECT_THAT(run({}, "nda generate poore-5.1 --help").output, HasSubstr("in [1, 100000000]"));
  const Outcome outcome =
      run({}, "nda generate tracking --targets 1 --scans 2 --group-size 10000000");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
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
      {"tracking --noise 1e20", "noise is 1e+20, must be in [1e-06, 1e+09]"},
      {"tracking --max-speed 1e20", "max_speed is 1e+20, must be in [0, 1e+09]"},
      {"tracking --process-noise 1e30", "process_noise is 1e+30, must be in [0, 1e+09]"},
      {"tracking --group-size 5 --group-spread 1e30", "group_spread is 1e+30, must be in"},
      {"groups --velocity-spread 1e30", "velocity_spread is 1e+30, must be in [0, 1e+09]"},
      {"tracking --targets 2000000000", "targets is 2e+09, must be in [1, 1e+07]"},
      {"tracking --scans 64 --max-misses 64",
       "scans and max_misses allow is 9223372036854775808, must be "},
      {"tracking --clutter 1e5", "scans times hypotheses of two false alarms is "},
      {"poore-5.3 --dimensions 10", "dimensions and sizes allow 2^30 tuples or more"},
      {"poore-5.1 --max-size 4294967295", "max_size is 4294967295, must be in [1, 1e+08]"},
      {"planted --arcs 18446744073709551615", "arcs is 18446744073709551616, must be in [0, 1e+"},
      {"planted --arcs 900000000", "dimensions times arcs is 4500005555.555"},
      {"planted --miss-rate 2", "miss_rate is 2, must be in [0, 0.9]"},
      {"tracking --preset giant", "no tracking preset is called giant"},
      {"planted --singletons dear", "--singletons"},
      {"poore-5.1 --arcs many", "--arcs"},
      {"poore-5.1 --arcs -1", "--arcs: '-1' given, it must be a whole number from 0 to "},
      {"map3 --seed -1", "--seed: '-1' given, it must be a whole number from 0 to "},
      {"tracking --seed -1", "--seed: '-1' given, it must be a whole number from 0 to "},
      {"map3 --seed 18446744073709551616", "--seed: '18446744073709551616' given, it must be a "},
      {"map3 --dimensions 1e1", "it must be a whole number from -2147483648 to 2147483647 (nda ge"},
      {"planted --singletons 2", "'2' given, it must be free, priced or forbidden"},
      {"map3 --frobnicate", "--frobnicate (nda generate map3 --help shows the usage)"},
      {"", "no family given (nda generate --help lists the families)"},
      {"poore", "poore (nda generate --help shows the usage)"},
      {"map3 --output /nowhere/a.nda", "/nowhere/a.nda"},
  };
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.arguments);
    const std::string limit = support::kIsSanitized ? "" : "ulimit -v 200000; ";
    const Outcome outcome = run({}, limit + "nda generate " + wrong.arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.output, "");
    EXPECT_THAT(outcome.log, HasSubstr(wrong.message));
    EXPECT_EQ(std::count(outcome.log.begin(), outcome.log.end(), '\n'), 1);
  }
}

}  // namespace
}  // namespace nda::cli
