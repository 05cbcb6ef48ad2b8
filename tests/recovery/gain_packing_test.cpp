#include "recovery/gain_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bnb/component_slack.hpp"
#include "core/random.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;

bool share_an_index(const Component& component, core::ArcId a, core::ArcId b) {
  for (int k = 0; k < component.num_dimensions(); ++k) {
    if (component.index(k, a) != 0 && component.index(k, a) == component.index(k, b)) return true;
  }
  return false;
}

struct Case {
  explicit Case(std::uint64_t seed)
      : component(support::random_component_of_any_kind(seed)), random(seed) {
    slack = bnb::slack_of(component, support::feasible_multipliers(component, random), kInfinity);
  }

  Component component;
  core::Random random;
  bnb::ComponentSlack slack{bnb::SlackProblem(0), {}};
};

TEST(Rivals, AreTheArcsThatShareAnIndexAndSaveAnything) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Case drawn(seed);
    const Rivals rivals(drawn.slack.problem);
    const auto arc = [&](std::uint32_t n) {
      return drawn.slack.arcs[rivals.arcs_of_problem(std::vector{n}).front()];
    };
    double num_listed = 0;
    for (std::uint32_t n = 0; n < rivals.num_arcs(); ++n) {
      num_listed += static_cast<double>(rivals[n].size());
      EXPECT_NEAR(rivals.value(n), -drawn.component.costs[arc(n)], 1e-9);
      EXPECT_GT(rivals.value(n), 0);
      for (std::uint32_t m = 0; m < rivals.num_arcs(); ++m) {
        const auto listed = rivals[n];
        const bool is_listed = std::find(listed.begin(), listed.end(), m) != listed.end();
        EXPECT_EQ(is_listed, n != m && share_an_index(drawn.component, arc(n), arc(m)));
      }
    }
    const double num_pairs = static_cast<double>(rivals.num_arcs()) * rivals.num_arcs();
    EXPECT_NEAR(rivals.density() * num_pairs, num_listed, 1e-9);
  }
}

// After any swaps: the gain of an arc is its value less those of its rivals that are in.
TEST(GainPacking, KnowsEveryGain) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Case drawn(seed);
    const Rivals rivals(drawn.slack.problem);
    GainPacking packing(rivals);
    for (int swap = 0; swap < 50 && rivals.num_arcs() > 0; ++swap) {
      const auto arrival = static_cast<std::uint32_t>(drawn.random.below(rivals.num_arcs()));
      if (packing.contains(arrival)) continue;
      for (const std::uint32_t rival : rivals[arrival]) {
        if (packing.contains(rival)) packing.remove(rival);
      }
      packing.insert(arrival);
    }
    double total = 0;
    for (std::uint32_t n = 0; n < rivals.num_arcs(); ++n) {
      double gain = rivals.value(n);
      bool is_excluded = false;
      for (const std::uint32_t rival : rivals[n]) {
        if (!packing.contains(rival)) continue;
        gain -= rivals.value(rival);
        is_excluded = true;
      }
      if (packing.contains(n)) {
        total += rivals.value(n);
        EXPECT_EQ(packing.gain(n), -kInfinity);
      } else {
        EXPECT_NEAR(packing.gain(n), gain, 1e-9);
        EXPECT_EQ(packing.fits(n), !is_excluded);
      }
    }
    EXPECT_NEAR(packing.total(), total, 1e-9);
  }
}

}  // namespace
}  // namespace nda::recovery
