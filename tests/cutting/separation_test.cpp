#include "cutting/separation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;

const core::Deadline kNever;

// x of a relaxed optimum.
struct Point {
  std::vector<ArcId> arcs;
  std::vector<double> x;
};

Point relaxed_optimum(const Component& component) {
  Master master(component, all_arcs(component), no_multipliers(component));
  EXPECT_EQ(master.solve(kInfinity, kNever), lp::Outcome::kOptimal);
  return {{master.arcs().begin(), master.arcs().end()},
          {master.values().begin(), master.values().end()}};
}

double violation_of(const Component& component, const Point& point, const Cut& cut) {
  CutLister lister(component.num_arcs());
  const SlotIndex index(component, all_arcs(component));
  double left = 0;
  for (const CutEntry& entry : lister.list(cut, index)) {
    const auto place = std::find(point.arcs.begin(), point.arcs.end(), entry.arc);
    if (place != point.arcs.end()) left += entry.coefficient * point.x[place - point.arcs.begin()];
  }
  return left - cut.right_side();
}

TEST(Separator, FindsTheCliqueOfTheTriangle) {
  const Component component = triangle();
  const std::vector<ArcId> arcs = all_arcs(component);
  const std::vector<double> halves(3, 0.5);
  Separator separator(component, arcs, halves);
  const std::vector<ViolatedCut> cuts = separator.three_rows(0.01, {});
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_NEAR(cuts[0].violation, 0.5, 1e-12);
  EXPECT_THAT(cuts[0].cut.slots, testing::ElementsAre(1, 3, 5));
}

TEST(Separator, SeesNothingInAPacking) {
  const Component component = triangle();
  const std::vector<ArcId> arcs = all_arcs(component);
  const std::vector<double> packing = {1, 0, 0};
  EXPECT_TRUE(Separator(component, arcs, packing).integral());
}

TEST(Separator, StatesViolationsAsTheyAre) {
  int found = 0;
  core::Random random(1);
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Component component = fractional_component(seed);
    const Point point = relaxed_optimum(component);
    Separator separator(component, point.arcs, point.x);
    std::vector<ViolatedCut> cuts = separator.three_rows(0.01, {});
    for (const Pattern& pattern : patterns()) {
      const auto more = separator.search(pattern, {0.01, 1, 3}, random(), kNever);
      cuts.insert(cuts.end(), more.begin(), more.end());
    }
    for (const ViolatedCut& cut : cuts) {
      ASSERT_NEAR(cut.violation, violation_of(component, point, cut.cut), 1e-5) << "seed " << seed;
      ASSERT_GT(cut.violation, 0.01);
      ++found;
    }
  }
  EXPECT_GT(found, 200);
}

// Against trying all triples of slots.
TEST(Separator, ThreeRowsMissesNone) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Component component = fractional_component(seed);
    const Point point = relaxed_optimum(component);
    std::set<std::vector<std::uint32_t>> expected;
    const auto n = static_cast<std::uint32_t>(component.num_slots());
    for (std::uint32_t r = 0; r < n; ++r) {
      for (std::uint32_t s = r + 1; s < n; ++s) {
        for (std::uint32_t t = s + 1; t < n; ++t) {
          if (violation_of(component, point, {{r, s, t}, {1, 1, 1}, 2}) > 0.05)
            expected.insert({r, s, t});
        }
      }
    }
    std::set<std::vector<std::uint32_t>> listed;
    for (const ViolatedCut& cut : Separator(component, point.arcs, point.x).three_rows(0.05, {})) {
      listed.insert(cut.cut.slots);
    }
    ASSERT_EQ(listed, expected) << "seed " << seed;
    found += static_cast<int>(listed.size());
  }
  EXPECT_GT(found, 100);
}

TEST(Patterns, AreDescendingBelowTheDivisorAndWorthRounding) {
  for (const Pattern& pattern : patterns()) {
    EXPECT_TRUE(std::is_sorted(pattern.weights.rbegin(), pattern.weights.rend()));
    EXPECT_LT(pattern.weights.front(), pattern.divisor);
    const int total = std::accumulate(pattern.weights.begin(), pattern.weights.end(), 0);
    EXPECT_NE(total % pattern.divisor, 0);  // else the cut is the sum of its rows
  }
}

}  // namespace
}  // namespace nda::cutting
