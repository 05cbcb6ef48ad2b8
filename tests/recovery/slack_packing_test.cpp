#include "recovery/slack_packing.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "bnb/component_slack.hpp"
#include "core/random.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

constexpr double kTie = 1e-9;

TEST(SlackPacking, SlackIsCostBeyondTheMultipliers) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const core::Component component = support::random_component_of_any_kind(seed);
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    const bnb::ComponentSlack slack = bnb::slack_of(component, u, kInfinity);
    SlackPacking packing(slack.problem);
    std::vector<std::uint32_t> in;
    for (int move = 0; move < 50 && slack.problem.num_arcs() > 0; ++move) {
      const auto arc = static_cast<std::uint32_t>(random.below(slack.problem.num_arcs()));
      if (packing.fits(arc)) {
        packing.insert(arc);
      } else if (packing.owner(slack.problem.uses(arc).front().row) == arc) {
        packing.remove(arc);
      }
      in = packing.arcs();
      const double cost = core::make_packing(component, {in.begin(), in.end()}).cost;
      const double base = std::accumulate(u.begin(), u.end(), 0.0);
      ASSERT_NEAR(base + packing.slack(), cost, kTie);
    }
    SlackPacking again(slack.problem);
    again.assign(in);
    EXPECT_NEAR(again.slack(), packing.slack(), kTie);
    EXPECT_EQ(again.arcs(), in);
  }
}

// Two arcs, one index each, and a cut of capacity 1 over both that costs 3 if it is not filled.
TEST(SlackPacking, CutsCostWhatIsLeftOfThem) {
  bnb::SlackProblem problem(2);
  problem.add_row(5);
  problem.add_row(7);
  problem.add_row(3, 2);
  problem.add_arc(1, std::vector<bnb::RowUse>{{0, 1}, {2, 2}});
  problem.add_arc(2, std::vector<bnb::RowUse>{{1, 1}});
  SlackPacking packing(problem);
  EXPECT_EQ(packing.slack(), 5 + 7 + 6);
  packing.insert(0);
  EXPECT_EQ(packing.slack(), 1 + 7);
  EXPECT_EQ(packing.left(2), 0u);
  packing.insert(1);
  EXPECT_EQ(packing.slack(), 1 + 2);
  packing.remove(0);
  EXPECT_EQ(packing.slack(), 5 + 2 + 6);
  EXPECT_EQ(packing.arcs(), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace nda::recovery
