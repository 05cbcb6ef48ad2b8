#include "nda/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace nda {
namespace {

using ::testing::HasSubstr;

// What validate() says after one change of the defaults; empty when it accepts.
std::string verdict(const std::function<void(Options&)>& change) {
  Options options;
  change(options);
  try {
    validate(options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Options, DefaultsAreValid) {
  EXPECT_EQ(verdict([](Options&) {}), "");
}

struct Range {
  const char* name;
  std::function<void(Options&)> good;  // at the edge of the range
  std::function<void(Options&)> bad;   // just beyond
};

void PrintTo(const Range& range, std::ostream* out) {
  *out << range.name;
}

class OptionRanges : public ::testing::TestWithParam<Range> {};

TEST_P(OptionRanges, AcceptTheirEdgeAndNameWhatIsBeyond) {
  EXPECT_EQ(verdict(GetParam().good), "");
  EXPECT_THAT(verdict(GetParam().bad), HasSubstr(std::string("option ") + GetParam().name + " is"));
}

const double kNan = std::nan("");

INSTANTIATE_TEST_SUITE_P(
    All,
    OptionRanges,
    ::testing::Values(Range{"time_limit_s",
                            [](Options& o) { o.time_limit_s = 1e-9; },
                            [](Options& o) { o.time_limit_s = 0; }},
                      Range{"time_limit_s",
                            [](Options& o) { o.time_limit_s = kInfinity; },
                            [](Options& o) { o.time_limit_s = kNan; }},
                      Range{"relative_gap",
                            [](Options& o) { o.relative_gap = 0; },
                            [](Options& o) { o.relative_gap = -1e-9; }},
                      Range{"relative_gap",
                            [](Options& o) { o.relative_gap = 0.5; },
                            [](Options& o) { o.relative_gap = kNan; }},
                      Range{"num_threads",
                            [](Options& o) { o.num_threads = 0; },
                            [](Options& o) { o.num_threads = -1; }},
                      Range{"num_threads",
                            [](Options& o) { o.num_threads = 1024; },
                            [](Options& o) { o.num_threads = 1025; }},
                      Range{"relaxation.kept_sets",
                            [](Options& o) { o.relaxation.kept_sets = 0; },
                            [](Options& o) { o.relaxation.kept_sets = -1; }},
                      Range{"relaxation.kept_sets",
                            [](Options& o) { o.relaxation.kept_sets = 64; },
                            [](Options& o) { o.relaxation.kept_sets = 65; }},
                      Range{"relaxation.kept_nodes",
                            [](Options& o) { o.relaxation.kept_nodes = 0; },
                            [](Options& o) { o.relaxation.kept_nodes = -1; }},
                      Range{"relaxation.kept_evaluations",
                            [](Options& o) { o.relaxation.kept_evaluations = 1; },
                            [](Options& o) { o.relaxation.kept_evaluations = 0; }},
                      Range{"relaxation.set_order",
                            [](Options& o) { o.relaxation.set_order = SetOrder::kProbe; },
                            [](Options& o) { o.relaxation.set_order = static_cast<SetOrder>(4); }},
                      Range{"relaxation.max_evaluations",
                            [](Options& o) { o.relaxation.max_evaluations = 1; },
                            [](Options& o) { o.relaxation.max_evaluations = 0; }},
                      Range{"relaxation.recovery_evaluations",
                            [](Options& o) { o.relaxation.recovery_evaluations = 1; },
                            [](Options& o) { o.relaxation.recovery_evaluations = 0; }},
                      Range{"relaxation.recovery_interval",
                            [](Options& o) { o.relaxation.recovery_interval = 1; },
                            [](Options& o) { o.relaxation.recovery_interval = 0; }},
                      Range{"relaxation.relative_tolerance",
                            [](Options& o) { o.relaxation.relative_tolerance = 0; },
                            [](Options& o) { o.relaxation.relative_tolerance = -1; }},
                      Range{"relaxation.relative_tolerance",
                            [](Options& o) { o.relaxation.relative_tolerance = 1; },
                            [](Options& o) { o.relaxation.relative_tolerance = kNan; }},
                      Range{"method",
                            [](Options& o) { o.method = Method::kExact; },
                            [](Options& o) { o.method = static_cast<Method>(3); }},
                      Range{"search.kicks_per_index",
                            [](Options& o) { o.search.kicks_per_index = 0; },
                            [](Options& o) { o.search.kicks_per_index = -1; }},
                      Range{"branch.max_nodes",
                            [](Options& o) { o.branch.max_nodes = 0; },
                            [](Options& o) { o.branch.max_nodes = -1; }},
                      Range{"branch.node_evaluations",
                            [](Options& o) { o.branch.node_evaluations = 1; },
                            [](Options& o) { o.branch.node_evaluations = 0; }}));

TEST(Options, NameTheFirstThatIsOutOfRange) {
  EXPECT_THAT(verdict([](Options& o) {
                o.branch.node_evaluations = 0;
                o.num_threads = -3;
              }),
              HasSubstr("num_threads is -3"));
}

TEST(Options, AreTooLargeInFewDigits) {
  EXPECT_EQ(verdict([](Options& o) { o.relative_gap = -1e300; }),
            "option relative_gap is -1e+300, it must be a number, 0 or more");
  EXPECT_EQ(verdict([](Options& o) { o.num_threads = 1000000; }),
            "option num_threads is 1000000, it must be a whole number from 0 to 1024");
}

TEST(Presets, AreValidAndDiffer) {
  for (const char* name : {"default", "realtime", "exact"}) {
    SCOPED_TRACE(name);
    EXPECT_NO_THROW(validate(preset(name)));
  }
  EXPECT_EQ(preset("default").time_limit_s, kInfinity);
  EXPECT_LE(preset("realtime").time_limit_s, 0.1);
  EXPECT_GT(preset("realtime").relative_gap, 0);
  EXPECT_EQ(preset("exact").relative_gap, 0);
  EXPECT_EQ(preset("exact").time_limit_s, kInfinity);
}

TEST(Presets, UnknownOnesAreRefusedByName) {
  try {
    preset("quick");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'quick'"));
  }
}

}  // namespace
}  // namespace nda
