#include "recovery/annealing_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bnb/component_slack.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;
using core::Random;
using support::packing_fault;

class Annealed {
 public:
  explicit Annealed(const Component& component, std::uint64_t seed = 1)
      : component_(component), random_(seed), slack_(slack(component, seed)) {}

  // The best cost of a run that works so much.
  double run(double work, const core::Deadline& deadline = {}) {
    double best = 0;
    search_.run({work, deadline}, random_, [&](auto arcs) {
      found_.push_back(core::make_packing(component_, core::at_positions(slack_.arcs, arcs)));
      best = std::min(best, found_.back().cost);
    });
    return best;
  }

  const std::vector<Packing>& found() const { return found_; }

 private:
  static bnb::ComponentSlack slack(const Component& component, std::uint64_t seed) {
    Random multipliers(seed);
    return bnb::slack_of(
        component, support::feasible_multipliers(component, multipliers), kInfinity);
  }

  const Component& component_;
  Random random_;
  const bnb::ComponentSlack slack_;
  const Rivals rivals_{slack_.problem};
  AnnealingSearch search_{rivals_};
  std::vector<Packing> found_;
};

Component crowded_component(std::uint64_t seed) {
  support::RandomComponentOptions options;
  options.sizes = {15, 15, 15, 15};
  options.num_arcs = 1500;
  return support::random_component(seed, options);
}

// No proof, but chance tries everything there is among a dozen arcs.
TEST(AnnealingSearch, FindsTheBestPackingOfSmallComponents) {
  int num_found = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Component component = support::random_component_of_any_kind(seed);
    Annealed annealed(component, seed);
    EXPECT_NEAR(annealed.run(1e5), support::best_cost(component), 1e-9) << "seed " << seed;
    for (const Packing& packing : annealed.found())
      ASSERT_EQ(packing_fault(component, packing), "");
    num_found += !annealed.found().empty();
  }
  EXPECT_GT(num_found, 400);
}

// More work is slower annealing and more children.
TEST(AnnealingSearch, GetsBetterWithMoreWork) {
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Component component = crowded_component(seed);
    const double early = Annealed(component, seed).run(1);
    const double late = Annealed(component, seed).run(2e7);
    EXPECT_LE(late, early);
    num_better += late < early - 1e-9;
  }
  EXPECT_GE(num_better, 9);
}

// The fifth population begins with the best of the four before, where they differ.
TEST(AnnealingSearch, GoesOnFromTheBestOfEarlierPopulations) {
  int num_tried = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Component component = crowded_component(seed);
    Annealed annealed(component, seed);
    double best = 0;
    std::vector<double> bests;
    for (int run = 0; run < 4; ++run) bests.push_back(annealed.run(1e6));
    for (const double cost : bests) best = std::min(best, cost);
    const bool all_differ = std::set<double>(bests.begin(), bests.end()).size() == bests.size();
    if (!all_differ) continue;
    EXPECT_LE(annealed.run(1e6), best + 1e-9) << "seed " << seed;
    ++num_tried;
  }
  EXPECT_GT(num_tried, 0);
}

TEST(AnnealingSearch, IsDeterministic) {
  const Component component = crowded_component(7);
  Annealed once(component, 3);
  Annealed twice(component, 3);
  EXPECT_EQ(once.run(1e6), twice.run(1e6));
  ASSERT_EQ(once.found().size(), twice.found().size());
  for (std::size_t n = 0; n < once.found().size(); ++n)
    EXPECT_EQ(once.found()[n].arcs, twice.found()[n].arcs);
}

TEST(AnnealingSearch, StopsAtTheDeadlineAndWithoutArcs) {
  const Rivals none{bnb::SlackProblem(0)};
  Random random(1);
  const auto never = [](std::vector<std::uint32_t>) { FAIL(); };
  EXPECT_EQ(AnnealingSearch(none).run({1e6, {}}, random, never), 0);
  const Component component = support::random_component_of_any_kind(7);
  Annealed late(component);
  EXPECT_EQ(late.run(1e12, core::Deadline(0)), 0);
  EXPECT_TRUE(late.found().empty());
}

}  // namespace
}  // namespace nda::recovery
