#include "nda/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/option_table.hpp"

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

// What they are does not change with the defaults.
constexpr std::pair<const char*, const char*> kPapers[] = {
    {"poore-rijavec-1993",
     "method=relaxation relaxation.kept_sets=64 relaxation.kept_exact_arcs=5 "
     "relaxation.kept_nodes=1000 relaxation.kept_evaluations=10 "
     "relaxation.two_first=false relaxation.merit=true relaxation.decompose=true "
     "relaxation.set_order=as_given relaxation.recovery_order=as_given "
     "relaxation.dual_method=bundle relaxation.assign2d=auction "
     "relaxation.recovery=recursive relaxation.max_evaluations=50 "
     "relaxation.recovery_evaluations=10 relaxation.recovery_interval=1000000 "
     "relaxation.relative_tolerance=1e-07 relaxation.alignment=best_value "
     "relaxation.inner_evaluations=0 search.reductions=none search.local_search=false "
     "search.dimensionwise=false "
     "search.kicks_per_index=0 ranking.method=exact ranking.branches=4 "
     "ranking.local_search=false "},
    {"deb-1992",
     "method=relaxation relaxation.kept_sets=64 relaxation.kept_exact_arcs=0 "
     "relaxation.kept_nodes=0 relaxation.kept_evaluations=2 relaxation.two_first=false "
     "relaxation.merit=false relaxation.decompose=false relaxation.set_order=as_given "
     "relaxation.recovery_order=as_given relaxation.dual_method=subgradient "
     "relaxation.assign2d=auction relaxation.recovery=recursive "
     "relaxation.max_evaluations=50 relaxation.recovery_evaluations=2 "
     "relaxation.recovery_interval=1 relaxation.relative_tolerance=1e-07 "
     "relaxation.alignment=best_value relaxation.inner_evaluations=0 "
     "search.reductions=none search.local_search=false search.dimensionwise=false "
     "search.kicks_per_index=0 "
     "ranking.method=exact ranking.branches=4 "
     "ranking.local_search=false "},
    {"poore-1995",
     "method=relaxation relaxation.kept_sets=2 relaxation.kept_exact_arcs=2000 "
     "relaxation.kept_nodes=100000 relaxation.kept_evaluations=20 "
     "relaxation.two_first=false relaxation.merit=true relaxation.decompose=true "
     "relaxation.set_order=as_given relaxation.recovery_order=as_given "
     "relaxation.dual_method=bundle relaxation.assign2d=auction "
     "relaxation.recovery=recursive relaxation.max_evaluations=10 "
     "relaxation.recovery_evaluations=10 relaxation.recovery_interval=1000000 "
     "relaxation.relative_tolerance=1e-07 relaxation.alignment=best_value "
     "relaxation.inner_evaluations=0 search.reductions=none search.local_search=false "
     "search.dimensionwise=false "
     "search.kicks_per_index=0 ranking.method=exact ranking.branches=4 "
     "ranking.local_search=false "},
    {"partial-bnb",
     "method=relaxation relaxation.kept_sets=2 relaxation.kept_exact_arcs=2000 "
     "relaxation.kept_nodes=100000 relaxation.kept_evaluations=20 "
     "relaxation.two_first=false relaxation.merit=true relaxation.decompose=true "
     "relaxation.set_order=as_given relaxation.recovery_order=as_given "
     "relaxation.dual_method=bundle relaxation.assign2d=auction "
     "relaxation.recovery=recursive relaxation.max_evaluations=10 "
     "relaxation.recovery_evaluations=10 relaxation.recovery_interval=1000000 "
     "relaxation.relative_tolerance=1e-07 relaxation.alignment=least_violation "
     "relaxation.inner_evaluations=10 search.reductions=none search.local_search=false "
     "search.dimensionwise=false "
     "search.kicks_per_index=0 ranking.method=alignments ranking.branches=4 "
     "ranking.local_search=false "},
    {"murty-bnb",
     "method=relaxation relaxation.kept_sets=2 relaxation.kept_exact_arcs=2000 "
     "relaxation.kept_nodes=100000 relaxation.kept_evaluations=20 "
     "relaxation.two_first=false relaxation.merit=true relaxation.decompose=true "
     "relaxation.set_order=as_given relaxation.recovery_order=as_given "
     "relaxation.dual_method=bundle relaxation.assign2d=auction "
     "relaxation.recovery=recursive relaxation.max_evaluations=10 "
     "relaxation.recovery_evaluations=10 relaxation.recovery_interval=1000000 "
     "relaxation.relative_tolerance=1e-07 relaxation.alignment=least_violation "
     "relaxation.inner_evaluations=10 search.reductions=none search.local_search=false "
     "search.dimensionwise=false "
     "search.kicks_per_index=0 ranking.method=murty ranking.branches=4 "
     "ranking.local_search=false "},
};

std::string settings(const Options& options) {
  std::string text;
  for (const core::OptionRow& row : core::option_table()) {
    for (const char* group : {"method", "relaxation.", "search.", "ranking."}) {
      if (row.name.starts_with(group)) text += row.name + "=" + row.text(options) + " ";
    }
  }
  return text;
}

TEST(Presets, OfPapersAreFrozen) {
  for (const auto& [name, text] : kPapers) EXPECT_EQ(settings(preset(name)), text) << name;
  const auto papers = std::ranges::count_if(presets(), &PresetInfo::is_paper);
  EXPECT_EQ(static_cast<std::size_t>(papers), std::size(kPapers));
}

TEST(Presets, AreAllValid) {
  for (const PresetInfo& line : presets())
    EXPECT_NO_THROW(validate(preset(line.name))) << line.name;
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
