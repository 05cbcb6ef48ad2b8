#include "generate/option_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "generate/parameters.hpp"

namespace nda::generate {
namespace {

// Whether the family answers: with a problem of finite costs, or by naming what is wrong.
template <typename Options>
bool answers(Instance (*generate)(const Options&), const Options& options) {
  try {
    const Instance instance = generate(options);
    for (const double cost : instance.problem.costs()) {
      if (!(std::abs(cost) <= 1e9)) return false;
    }
    return true;
  } catch (const InputError& error) {
    return std::string(error.what()).find(", must be ") != std::string::npos ||
           std::string(error.what()).find("more than ") != std::string::npos ||
           std::string(error.what()).find("no gadget ") != std::string::npos;
  }
}

template <typename T>
std::vector<T> extremes(double least, double most) {
  using Limits = std::numeric_limits<T>;
  std::vector<T> values = {0, static_cast<T>(-1), 1, Limits::lowest(), Limits::max()};
  if constexpr (std::is_floating_point_v<T>) {
    values.insert(values.end(), {1e-300, -1e-300, 1e9, 1e30, -1e30, least, most});
    values.insert(values.end(), {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()});
  }
  return values;
}

template <typename Options>
void expect_answers(const char* family,
                    Instance (*generate)(const Options&),
                    const Options& options = {}) {
  for_each_row(OptionTable<Options>::kRows, [&](const auto& row) {
    Options changed = options;
    using T = std::remove_reference_t<decltype(changed.*row.field)>;
    for (const T value : extremes<T>(row.least, row.most)) {
      SCOPED_TRACE(std::string(family) + " " + row.name + " " + std::to_string(value));
      changed.*row.field = value;
      EXPECT_TRUE(answers(generate, changed));
      const double number = static_cast<double>(value);
      if (!(number >= row.least && number <= row.most)) {
        EXPECT_THROW(generate(changed), InputError);
      }
    }
  });
}

TEST(OptionTable, HoldsWhateverIsAsked) {
  expect_answers("poore-5.1", generate_poore_sparse);
  expect_answers("poore-5.3", generate_poore_dense);
  expect_answers("map3", generate_map3);
  expect_answers("planted", generate_planted);
  expect_answers("gadgets", generate_gadgets);
  expect_answers("bounded", generate_bounded);
  expect_answers("merged", generate_merged);
  expect_answers("tracking", generate_tracking);
  expect_answers("groups", generate_tracking, tracking_preset("hard6"));
}

TEST(OptionTable, HasTheDefaultsInRange) {
  EXPECT_NO_THROW(require_ranges(PooreSparseOptions()));
  EXPECT_NO_THROW(require_ranges(PooreDenseOptions()));
  EXPECT_NO_THROW(require_ranges(Map3Options()));
  EXPECT_NO_THROW(require_ranges(PlantedOptions()));
  EXPECT_NO_THROW(require_ranges(GadgetsOptions()));
  EXPECT_NO_THROW(require_ranges(BoundedOptions()));
  EXPECT_NO_THROW(require_ranges(MergedOptions()));
  EXPECT_NO_THROW(require_ranges(TrackingOptions()));
}

TEST(OptionTable, SpellsFlagsWithDashes) {
  EXPECT_EQ(flag_of("arcs_per_gadget"), "--arcs-per-gadget");
}

TEST(Parameters, SpellOutAllDigits) {
  PooreDenseOptions options;
  options.share = 1e-7;
  options.seed = 5;
  EXPECT_EQ(Parameters("poore-5.3", options).command(),
            "nda generate poore-5.3 --seed 5 --dimensions 4 --min-size 7 --max-size 7 "
            "--share 0.0000001");
}

}  // namespace
}  // namespace nda::generate
