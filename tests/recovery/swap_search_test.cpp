#include "recovery/swap_search.hpp"

#include <gtest/gtest.h>

#include "bnb/component_slack.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;
using core::Random;
using support::packing_fault;

constexpr std::size_t kAllStarts = 1000000;

std::vector<Packing> search(const Component& component, double work, std::uint64_t seed = 1) {
  Random multipliers(seed);
  const std::vector<double> u = support::feasible_multipliers(component, multipliers);
  const bnb::ComponentSlack slack = bnb::slack_of(component, u, kInfinity);
  Random random(seed);
  std::vector<Packing> found;
  SwapSearch(Rivals(slack.problem)).run({work, kAllStarts, {}}, random, [&](auto arcs) {
    found.push_back(core::make_packing(component, core::at_positions(slack.arcs, arcs)));
  });
  return found;
}

double best_of(const std::vector<Packing>& packings) {
  double best = 0;
  for (const Packing& packing : packings) best = std::min(best, packing.cost);
  return best;
}

// No proof, but the steps of one start see through a dozen arcs.
TEST(SwapSearch, FindsTheBestPackingOfSmallComponents) {
  int num_found = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Component component = support::random_component_of_any_kind(seed);
    const std::vector<Packing> found = search(component, 3e4, seed);
    for (const Packing& packing : found) ASSERT_EQ(packing_fault(component, packing), "");
    EXPECT_NEAR(best_of(found), support::best_cost(component), 1e-9) << "seed " << seed;
    num_found += !found.empty();
  }
  EXPECT_GT(num_found, 400);
}

// Work of 1 ends with the random packing of the first start, which is bad where arcs are many.
TEST(SwapSearch, GetsBetterWithMoreWork) {
  support::RandomComponentOptions options;
  options.sizes = {15, 15, 15, 15};
  options.num_arcs = 1500;
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Component component = support::random_component(seed, options);
    const double early = best_of(search(component, 1, seed));
    const double late = best_of(search(component, 2e6, seed));
    EXPECT_LE(late, early);
    num_better += late < early - 1e-9;
  }
  EXPECT_GE(num_better, 9);
}

TEST(SwapSearch, IsDeterministic) {
  const Component component = support::random_component_of_any_kind(7);
  const std::vector<Packing> once = search(component, 1e5, 3);
  const std::vector<Packing> twice = search(component, 1e5, 3);
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t n = 0; n < once.size(); ++n) EXPECT_EQ(once[n].arcs, twice[n].arcs);
}

TEST(SwapSearch, StopsAtTheDeadlineAndWithoutArcs) {
  const Rivals none{bnb::SlackProblem(0)};
  Random random(1);
  const auto never = [](std::vector<std::uint32_t>) { FAIL(); };
  EXPECT_EQ(SwapSearch(none).run({1e6, kAllStarts, {}}, random, never), 0);
  const Component component = support::random_component_of_any_kind(7);
  const std::vector<double> u = support::feasible_multipliers(component, random);
  const bnb::ComponentSlack slack = bnb::slack_of(component, u, kInfinity);
  SwapSearch(Rivals(slack.problem)).run({1e12, kAllStarts, core::Deadline(0)}, random, never);
}

}  // namespace
}  // namespace nda::recovery
