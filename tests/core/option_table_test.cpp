#include "core/option_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace nda::core {
namespace {

using ::testing::HasSubstr;

// What set_option() says; empty when it accepts.
std::string verdict(const std::string& name, const std::string& value, Options& options) {
  try {
    set_option(name, value, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OptionTable, NamesEveryOptionOnce) {
  std::set<std::string> names;
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(&find_option(row.name), &row);
    EXPECT_NE(row.meaning, "") << row.name;
    EXPECT_NE(row.rule, "") << row.name;
  }
  EXPECT_THROW(find_option("Seed"), InputError);
}

TEST(OptionTable, ReadsBackTheTextOfEveryDefault) {
  for (const OptionRow& row : option_table()) {
    SCOPED_TRACE(row.name);
    Options options;
    EXPECT_TRUE(row.holds(options));
    const std::string text = row.text(options);
    EXPECT_TRUE(row.read(text, options)) << text;
    EXPECT_EQ(row.text(options), text);
  }
}

TEST(OptionTable, SetsFieldsOfEveryKind) {
  Options options;
  set_option("method", "exact", options);
  set_option("time_limit_s", "2.5", options);
  set_option("relative_gap", "1e-3", options);
  set_option("seed", "18446744073709551615", options);
  set_option("relaxation.dual_method", "volume", options);
  set_option("relaxation.assign2d", "auction", options);
  set_option("relaxation.recovery", "local_search", options);
  set_option("relaxation.max_evaluations", "7", options);
  set_option("search.local_search", "false", options);
  set_option("branch.max_nodes", "9000000000", options);
  set_option("branch.exact_arcs", "0", options);
  EXPECT_EQ(options.method, Method::kExact);
  EXPECT_EQ(options.time_limit_s, 2.5);
  EXPECT_EQ(options.relative_gap, 1e-3);
  EXPECT_EQ(options.seed, 18446744073709551615u);
  EXPECT_EQ(options.relaxation.dual_method, DualMethod::kVolume);
  EXPECT_EQ(options.relaxation.assign2d, Assign2dMethod::kAuction);
  EXPECT_EQ(options.relaxation.recovery, RecoveryMethod::kLocalSearch);
  EXPECT_EQ(options.relaxation.max_evaluations, 7);
  EXPECT_FALSE(options.search.local_search);
  EXPECT_EQ(options.branch.max_nodes, 9000000000);
  EXPECT_EQ(options.branch.exact_arcs, 0u);
}

TEST(OptionTable, NamesOfEnumeratorsStandInTheirOrder) {
  Options options;
  options.relaxation.dual_method = DualMethod::kCoordinate;
  options.relaxation.assign2d = Assign2dMethod::kNetworkSimplex;
  options.relaxation.recovery = RecoveryMethod::kDualGreedy;
  EXPECT_EQ(find_option("relaxation.dual_method").text(options), "coordinate");
  EXPECT_EQ(find_option("relaxation.assign2d").text(options), "network_simplex");
  EXPECT_EQ(find_option("relaxation.recovery").text(options), "dual_greedy");
}

TEST(OptionTable, RefusesWhatIsNoValueAndChangesNothing) {
  const struct {
    const char* name;
    const char* value;
  } kCases[] = {{"seed", "-1"},
                {"seed", "18446744073709551616"},
                {"seed", ""},
                {"seed", "1.5"},
                {"num_threads", "1025"},
                {"num_threads", "2 "},
                {"time_limit_s", "nan"},
                {"time_limit_s", "0"},
                {"relative_gap", "1%"},
                {"relaxation.relative_tolerance", "-1"},
                {"relaxation.dual_method", "Volume"},
                {"search.local_search", "2"}};
  for (const auto& wrong : kCases) {
    SCOPED_TRACE(wrong.name);
    Options options;
    const OptionRow& row = find_option(wrong.name);
    EXPECT_THAT(verdict(wrong.name, wrong.value, options),
                HasSubstr(std::string("option ") + wrong.name + " is '" + wrong.value +
                          "', it must be " + row.rule));
    EXPECT_EQ(row.text(options), row.text(Options()));
  }
  Options options;
  EXPECT_EQ(verdict("magic", "1", options), "option 'magic' is not known");
}

}  // namespace
}  // namespace nda::core
