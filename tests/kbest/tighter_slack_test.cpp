#include "kbest/tighter_slack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.hpp"
#include "support/slack_problems.hpp"

namespace nda::kbest {
namespace {

using core::ArcId;

core::Component random_component(core::Random& random) {
  core::Component component = core::make_component({3, 3, 3});
  for (Index i = 0; i <= 3; ++i) {
    for (Index j = 0; j <= 3; ++j) {
      for (Index k = 0; k <= 3; ++k) {
        const bool is_arc = (i > 0) + (j > 0) + (k > 0) > 1;
        const Index tuple[] = {i, j, k};
        if (is_arc && component.num_arcs() < 13 && random.below(3) == 0)
          core::append_arc(component, tuple, 0);
      }
    }
  }
  return component;
}

// Every third index must be used.
bnb::ComponentSlack random_slack(const core::Component& component, core::Random& random) {
  std::vector<double> price(component.num_slots(), 0);
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t, Index) {
    price[slot] = random.below(3) == 0 ? kInfinity : static_cast<double>(random.below(5));
  });
  std::vector<double> reduced;
  for (ArcId a = 0; a < component.num_arcs(); ++a)
    reduced.push_back(static_cast<double>(random.below(6)));
  return bnb::slack_of(component, price, reduced, kInfinity);
}

// All packings and their slacks, +inf where an index is alone that must not be.
std::vector<std::vector<ArcId>> all_packings(const core::Component& component) {
  std::vector<std::vector<ArcId>> packings;
  for (std::uint32_t set = 0; set < 1u << component.num_arcs(); ++set) {
    std::vector<ArcId> arcs;
    std::vector<int> used(component.num_slots(), 0);
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      if ((set >> a & 1) == 0) continue;
      arcs.push_back(a);
      core::for_each_slot(component, a, [&](std::uint32_t slot) { ++used[slot]; });
    }
    if (*std::max_element(used.begin(), used.end()) <= 1) packings.push_back(arcs);
  }
  return packings;
}

TEST(TighterSlack, KeepsWhatPackingsWithinReachDifferBy) {
  int cuts = 0;
  int tightened = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const core::Component component = random_component(random);
    const bnb::ComponentSlack before = random_slack(component, random);
    const std::vector<std::vector<ArcId>> packings = all_packings(component);
    const auto slack = [&](const std::vector<ArcId>& arcs) {
      return support::slack_of(before.problem, arcs);
    };
    const std::vector<ArcId> best =
        *std::min_element(packings.begin(), packings.end(), [&](const auto& a, const auto& b) {
          return slack(a) < slack(b);
        });
    if (!(slack(best) < kInfinity)) continue;
    const double reach = static_cast<double>(random.below(8)) + 0.5;
    const auto after = tighter_slack(component, before.problem, best, reach, 60, {});
    ASSERT_TRUE(after);
    cuts += after->problem.num_rows() > after->problem.num_indices();
    const auto tight = [&](const std::vector<ArcId>& arcs) {
      return support::slack_of(after->problem, core::positions_in(after->arcs, arcs));
    };
    tightened += tight(best) < slack(best) - 1e-6;
    EXPECT_LE(tight(best), slack(best) + 1e-6);
    for (const std::vector<ArcId>& arcs : packings) {
      if (!(slack(arcs) < slack(best) + reach)) continue;
      ASSERT_EQ(core::positions_in(after->arcs, arcs).size(), arcs.size());
      EXPECT_NEAR(tight(arcs) - tight(best), slack(arcs) - slack(best), 1e-6);
    }
  }
  EXPECT_GT(cuts, 5);
  EXPECT_GT(tightened, 100);
}

}  // namespace
}  // namespace nda::kbest
