#include "relax/set_order.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/components.hpp"

namespace nda::relax {
namespace {

using core::Component;
using ::testing::ElementsAre;

// Sizes 1, 3, 2, 3.  Dimension 2 has the most pairs of arcs that share an index: three arcs use
// its index 1; the first shares one pair, the others none.  An arc that costs too much counts
// nowhere.
Component sample() {
  Component component = core::make_component({1, 3, 2, 3});
  core::append_arc(component, std::vector<Index>{0, 1, 1, 1}, -5);
  core::append_arc(component, std::vector<Index>{0, 1, 2, 1}, 5);
  core::append_arc(component, std::vector<Index>{1, 2, 1, 2}, -5);
  core::append_arc(component, std::vector<Index>{1, 3, 1, 3}, -5);
  return component;
}

TEST(SetOrder, FollowsTheRule) {
  const Component component = sample();
  EXPECT_THAT(set_order(component, SetOrder::kAsGiven, {}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(set_order(component, SetOrder::kLargestFirst, {}), ElementsAre(1, 3, 2, 0));
  EXPECT_THAT(set_order(component, SetOrder::kMostConflictingFirst, {}), ElementsAre(2, 0, 1, 3));
}

// Of sets 1, 2 and 4 an odd cycle, of set 3 nothing but one arc: keeping the three closes the gap.
TEST(SetOrder, IsProbedByTheBoundThatItGives) {
  Component component = core::make_component({1, 1, 2, 1});
  core::append_arc(component, std::vector<Index>{0, 1, 0, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 0, 0, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 1, 0, 0}, -1);
  core::append_arc(component, std::vector<Index>{1, 1, 1, 0}, -0.5);
  LagrangianOptions loop;
  loop.kept.num_kept = 3;
  loop.kept.solve = [](const Component& problem, KeptAnswer& answer) {
    answer.best = {};
    for (const core::Packing& packing : support::all_packings(problem)) {
      if (packing.cost < answer.best.cost) answer.best = packing;
    }
    answer.exact = true;
    answer.lower = answer.best.cost;
    answer.u.assign(problem.num_slots(), 0.0);
    make_feasible(problem, answer.u);
  };
  EXPECT_THAT(set_order(component, SetOrder::kProbe, loop), ElementsAre(0, 1, 3, 2));
}

TEST(SetOrder, IsAPermutationWhereverThereAreTooManyChoices) {
  const Component component = support::random_component(1, {{2, 2, 2, 2, 2, 2, 2, 2}, 20, 0.5});
  std::vector<std::size_t> order = set_order(component, SetOrder::kProbe, {});
  std::sort(order.begin(), order.end());
  EXPECT_THAT(order, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
}

}  // namespace
}  // namespace nda::relax
