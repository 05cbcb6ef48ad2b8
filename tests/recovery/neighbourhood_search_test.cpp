#include "recovery/neighbourhood_search.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "bnb/component_slack.hpp"
#include "recovery/greedy.hpp"
#include "recovery/pool_search.hpp"
#include "support/components.hpp"
#include "support/other_orders.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Packing;
using core::Random;
using support::large_component;
using support::packing_fault;

constexpr double kTie = 1e-9;

// The two searches, as what they make of a packing of a component under random multipliers.
struct Neighbourhoods {
  static void improve(const bnb::SlackProblem& problem,
                      std::vector<std::uint32_t>& packing,
                      double work,
                      double goal,
                      Random& random,
                      const core::Deadline& deadline,
                      const core::ForAll& for_all) {
    NeighbourhoodSearch(problem).improve(
        packing, {work, goal, kInfinity, deadline, for_all}, random);
  }
};

struct Pool {
  static void improve(const bnb::SlackProblem& problem,
                      std::vector<std::uint32_t>& packing,
                      double work,
                      double goal,
                      Random& random,
                      const core::Deadline& deadline,
                      const core::ForAll& for_all) {
    PoolSearchOptions options;
    options.max_work = work;
    options.goal = goal;
    options.deadline = deadline;
    options.for_all = for_all;
    search_pool(problem, packing, options, random);
  }
};

template <typename Search>
Packing search(const Component& component,
               const Packing& start,
               double work,
               double goal = -kInfinity,
               std::uint64_t seed = 1,
               const core::Deadline& deadline = {},
               const core::ForAll& for_all = {}) {
  Random multipliers(seed);
  const std::vector<double> u = support::feasible_multipliers(component, multipliers);
  const bnb::ComponentSlack slack = bnb::slack_of(component, u, kInfinity);
  Random random(seed);
  Packing packing = start;
  Search::improve(slack.problem,
                  packing.arcs,
                  work,
                  goal - std::accumulate(u.begin(), u.end(), 0.0),
                  random,
                  deadline,
                  for_all);
  return core::make_packing(component, packing.arcs);
}

template <typename Search>
class SlackPackings : public testing::Test {};
using Searches = testing::Types<Neighbourhoods, Pool>;
TYPED_TEST_SUITE(SlackPackings, Searches);

TYPED_TEST(SlackPackings, NeverGetWorse) {
  int num_better = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    const Packing start = greedy(component, component.costs);
    const Packing found = search<TypeParam>(component, start, 1e5, -kInfinity, seed);
    ASSERT_EQ(packing_fault(component, found), "");
    ASSERT_LE(found.cost, start.cost + kTie);
    ASSERT_GE(found.cost, support::best_cost(component) - kTie);
    num_better += found.cost < start.cost - kTie;
  }
  EXPECT_GT(num_better, 50);
}

TYPED_TEST(SlackPackings, OfSmallComponentsBecomeBestFromNothing) {
  int num_missed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = support::random_component_of_any_kind(seed);
    const double best = std::min(0.0, support::best_cost(component));
    num_missed += search<TypeParam>(component, {}, 2e6, best, seed).cost > best + kTie;
  }
  EXPECT_LT(num_missed, 10);
}

TYPED_TEST(SlackPackings, AreSearchedUpToTheGoal) {
  const Component component = large_component(3);
  const Packing best = search<TypeParam>(component, {}, 2e7);
  const double goal = best.cost / 2;
  const Packing found = search<TypeParam>(component, {}, 2e7, goal);
  EXPECT_LE(found.cost, goal);
  EXPECT_EQ(search<TypeParam>(component, found, 2e7, found.cost + kTie).arcs, found.arcs);
}

TYPED_TEST(SlackPackings, AreTheSameWithoutALimitAndFarBelowIt) {
  const Component component = large_component(3);
  const double goal = 0.9 * search<TypeParam>(component, {}, 2e6).cost;
  EXPECT_EQ(search<TypeParam>(component, {}, kInfinity, goal).arcs,
            search<TypeParam>(component, {}, 1e15, goal).arcs);
}

TYPED_TEST(SlackPackings, AreDeterministic) {
  const Component component = large_component(4);
  EXPECT_EQ(search<TypeParam>(component, {}, 1e6).arcs, search<TypeParam>(component, {}, 1e6).arcs);
}

TYPED_TEST(SlackPackings, AreTheSameHoweverTheyAreSearched) {
  for (const std::uint64_t seed : {4, 5}) {
    const Component component = large_component(seed);
    const Packing in_turn = search<TypeParam>(component, {}, 1e6, -kInfinity, seed);
    for (const core::ForAll& for_all :
         {core::ForAll(support::backwards), core::ForAll(support::at_once)}) {
      const Packing other = search<TypeParam>(component, {}, 1e6, -kInfinity, seed, {}, for_all);
      EXPECT_EQ(in_turn.arcs, other.arcs);
    }
  }
}

TYPED_TEST(SlackPackings, StopAtTheDeadline) {
  const Component component = large_component(5);
  const core::Stopwatch watch;
  const Packing found =
      search<TypeParam>(component, {}, kInfinity, -kInfinity, 1, core::Deadline(0.02));
  EXPECT_LT(watch.seconds(), 5);
  EXPECT_EQ(packing_fault(component, found), "");
}

// Many small problems side by side, and the sum of their least slacks.
struct SideBySide {
  static constexpr std::uint64_t kCopies = 300;
  std::vector<bnb::SlackProblem> parts;
  bnb::SlackProblem all{0};
  double least = 0;

  SideBySide() {
    for (std::uint64_t seed = 0; seed < kCopies; ++seed) {
      const Component component = support::random_component(seed);
      Random multipliers(seed);
      const std::vector<double> u = support::feasible_multipliers(component, multipliers);
      parts.push_back(bnb::slack_of(component, u, kInfinity).problem);
      least += support::best_cost(component) - support::sum_of(u);
    }
    const auto add_rows = [](std::uint32_t sum, const bnb::SlackProblem& part) {
      return sum + part.num_rows();
    };
    all = bnb::SlackProblem(std::accumulate(parts.begin(), parts.end(), 0U, add_rows));
    for (const bnb::SlackProblem& part : parts) append(part);
  }

 private:
  void append(const bnb::SlackProblem& part) {
    const std::uint32_t first = all.num_rows();
    for (std::uint32_t row = 0; row < part.num_rows(); ++row) all.add_row(part.price(row));
    for (std::uint32_t arc = 0; arc < part.num_arcs(); ++arc) {
      std::vector<bnb::RowUse> uses(part.uses(arc).begin(), part.uses(arc).end());
      for (bnb::RowUse& use : uses) use.row += first;
      all.add_arc(part.reduced(arc), uses);
    }
  }
};

// Detours by a tenth of the whole gap leave 6 to 8 % here: they lead away faster than anything
// leads back.
TYPED_TEST(SlackPackings, OfThousandsOfIndicesAreNotLostOnDetours) {
  const SideBySide problem;
  std::vector<std::uint32_t> best;
  Random random(1);
  TypeParam::improve(problem.all, best, 1e5 * SideBySide::kCopies, -kInfinity, random, {}, {});
  SlackPacking packing(problem.all);
  packing.assign(best);
  EXPECT_LT(packing.slack(), 1.03 * problem.least);
  EXPECT_GE(packing.slack(), problem.least - 1e-6);
}

TYPED_TEST(SlackPackings, NeedArcs) {
  const Component none = core::make_component({2, 2});
  EXPECT_EQ(search<TypeParam>(none, {}, 1e6).cost, 0);
}

}  // namespace
}  // namespace nda::recovery
