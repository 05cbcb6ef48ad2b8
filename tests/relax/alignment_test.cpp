#include "relax/alignment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "relax/dual_function.hpp"
#include "relax/lagrangian.hpp"
#include "support/components.hpp"

namespace nda::relax {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Cells = std::vector<std::uint32_t>;

TEST(AlignmentPool, PrefersTheShorterSubgradient) {
  AlignmentPool pool(AlignmentRule::kLeastViolation, 2);
  const std::vector<double> point = {1};
  pool.offer(Cells{1}, point, -5, 4);
  EXPECT_TRUE(pool.would_lead(-9, 2));
  pool.offer(Cells{2}, point, -9, 2);
  EXPECT_FALSE(pool.would_lead(-9, 2)) << "it is there";
  EXPECT_TRUE(pool.would_lead(-8, 2)) << "of equal ones the better value";
  pool.offer(Cells{3}, point, -1, 6);
  ASSERT_EQ(pool.best().size(), 2u);
  EXPECT_EQ(pool.best()[0].cells, Cells{2});
  EXPECT_EQ(pool.best()[1].cells, Cells{1});
}

TEST(AlignmentPool, PrefersTheBetterValue) {
  AlignmentPool pool(AlignmentRule::kBestValue, 2);
  const std::vector<double> point = {1};
  pool.offer(Cells{1}, point, -5, 4);
  pool.offer(Cells{2}, point, -9, 2);
  pool.offer(Cells{3}, point, -1, 6);
  EXPECT_EQ(pool.best()[0].cells, Cells{3});
  EXPECT_EQ(pool.best()[1].cells, Cells{1});
  EXPECT_TRUE(pool.is_level(-1, 0)) << "violation does not count";
}

// One alignment, found three times: kept once, from its best point.
TEST(AlignmentPool, KeepsAnAlignmentOnce) {
  AlignmentPool pool(AlignmentRule::kBestValue, 5);
  pool.offer(Cells{1, 2}, std::vector<double>{1}, -5, 0);
  pool.offer(Cells{1, 2}, std::vector<double>{2}, -4, 0);
  pool.offer(Cells{1, 2}, std::vector<double>{3}, -6, 0);
  ASSERT_EQ(pool.best().size(), 1u);
  EXPECT_THAT(pool.best()[0].point, ElementsAre(2));
  EXPECT_EQ(pool.best()[0].value, -4);
}

// Against the definition: of every alignment the best offer, sorted, the first ones.
TEST(AlignmentPool, AgreesWithSorting) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    core::Random random(seed);
    const auto rule = seed % 2 == 0 ? AlignmentRule::kBestValue : AlignmentRule::kLeastViolation;
    const std::size_t capacity = 1 + random.below(5);
    AlignmentPool pool(rule, capacity);
    using Key = std::pair<double, double>;  // ascending: the best first
    std::map<Cells, Key> best_of;
    for (int offer = 0; offer < 30; ++offer) {
      const Cells cells = {static_cast<std::uint32_t>(random.below(8))};
      const double value = random.uniform(-10, 0);  // no ties
      const auto violation = static_cast<double>(random.below(4));
      pool.offer(cells, std::vector<double>{value}, value, violation);
      const Key key = rule == AlignmentRule::kBestValue ? Key{0, -value} : Key{violation, -value};
      const auto [place, is_new] = best_of.try_emplace(cells, key);
      if (!is_new) place->second = std::min(place->second, key);
    }
    std::vector<std::pair<Key, Cells>> expected;
    for (const auto& [cells, key] : best_of) expected.emplace_back(key, cells);
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min(expected.size(), capacity));
    ASSERT_EQ(pool.best().size(), expected.size()) << seed;
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ(pool.best()[i].cells, expected[i].second) << seed;
  }
}

// What the loop hands out is what the dual function says at those points.
TEST(AlignmentPool, HoldsWhatTheLoopSaw) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const core::Component component = support::random_component_of_any_kind(seed);
    if (component.num_dimensions() == 2) continue;
    LagrangianOptions options;
    options.max_evaluations = 20;
    options.num_alignments = 4;
    options.alignment_rule = AlignmentRule::kLeastViolation;
    const LagrangianResult result = maximize_dual(component, {}, options, {});
    ASSERT_FALSE(result.alignments.empty());
    for (const Alignment& alignment : result.alignments) {
      DualFunction function(component);
      std::vector<double> g(function.num_variables());
      EXPECT_NEAR(function.evaluate(alignment.point, g), alignment.value, 1e-6) << seed;
      EXPECT_LE(alignment.value, 1e-9);
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

}  // namespace
}  // namespace nda::relax
