#include "core/component.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "support/components.hpp"
#include "support/random_problems.hpp"

namespace nda::core {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Tuple = std::vector<Index>;

// Random ascending subset of 0..n-1.
std::vector<ArcId> random_subset(Random& random, std::size_t n, double share) {
  std::vector<ArcId> subset;
  for (ArcId a = 0; a < n; ++a) {
    if (random.uniform() < share) subset.push_back(a);
  }
  return subset;
}

// The tuple of arc a in the dimensions and indices of the problem the component came from.
Tuple tuple_in_problem(const Component& component, ArcId a, std::size_t num_dimensions) {
  Tuple tuple(num_dimensions, 0);
  for (int k = 0; k < component.num_dimensions(); ++k) {
    tuple[component.dimensions[static_cast<std::size_t>(k)]] =
        component.origin[component.slot(k, a)];
  }
  return tuple;
}

std::vector<Tuple> tuples_of(const Component& component) {
  std::vector<Tuple> tuples;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    tuples.emplace_back();
    for (int k = 0; k < component.num_dimensions(); ++k) {
      tuples.back().push_back(component.index(k, a));
    }
  }
  return tuples;
}

// Every sentence about the members of Component that holds for any of them.
void expect_consistent(const Component& component) {
  const std::size_t n = component.sizes.size();
  ASSERT_EQ(component.offset.size(), n);
  ASSERT_EQ(component.dimensions.size(), n);
  ASSERT_EQ(component.indices.size(), n);
  ASSERT_EQ(component.origin.size(), component.num_slots());
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(component.offset[k], next);
    EXPECT_EQ(component.origin[next], 0u) << "the dummy stands for the dummy";
    EXPECT_EQ(component.indices[k].size(), component.num_arcs());
    next += component.sizes[k] + 1;
  }
  EXPECT_EQ(component.num_slots(), next);
  EXPECT_EQ(component.num_indices(), next - n);
  const std::vector<Tuple> tuples = tuples_of(component);
  EXPECT_TRUE(std::is_sorted(tuples.begin(), tuples.end()));
}

// A cut has no index that none of its arcs uses, and no empty dimension.
void expect_no_unused_index(const Component& component) {
  std::vector<bool> used(component.num_slots(), false);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    for_each_slot(component, a, [&](std::uint32_t slot) { used[slot] = true; });
  }
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    EXPECT_GE(component.sizes[k], 1u);
    EXPECT_FALSE(used[component.offset[k]]) << "for_each_slot visited a dummy";
    for (Index i = 1; i <= component.sizes[k]; ++i) EXPECT_TRUE(used[component.offset[k] + i]);
  }
}

TEST(MakeComponent, NumbersSlotsDimensionByDimension) {
  const Component component = make_component({2, 0, 3});
  EXPECT_THAT(component.offset, ElementsAre(0, 3, 4));
  EXPECT_THAT(component.origin, ElementsAre(0, 1, 2, 0, 0, 1, 2, 3));
  EXPECT_THAT(component.dimensions, ElementsAre(0, 1, 2));
  EXPECT_EQ(component.num_slots(), 8u);
  EXPECT_EQ(component.num_indices(), 5u);
  EXPECT_EQ(component.num_arcs(), 0u);
  EXPECT_THAT(component.arc_origin, IsEmpty());
}

TEST(MakeComponent, OfNoDimensionsIsEmpty) {
  const Component component = make_component({});
  EXPECT_EQ(component.num_slots(), 0u);
  EXPECT_EQ(component.num_dimensions(), 0);
}

TEST(Component, GivesSlotsAndReducedCosts) {
  Component component = make_component({2, 2, 1});
  append_arc(component, Tuple{1, 2, 0}, -4);
  append_arc(component, Tuple{2, 1, 1}, -3);
  EXPECT_EQ(component.slot(0, 1), 2u);
  EXPECT_EQ(component.slot(1, 0), 5u);
  EXPECT_EQ(component.slot(2, 0), 6u) << "of the dummy";
  const std::vector<double> u = {0, -1, -2, 0, -0.5, -0.25, 0, -8};
  EXPECT_DOUBLE_EQ(reduced_cost(component, u, 0), -4 + 1 + 0.25);
  EXPECT_DOUBLE_EQ(reduced_cost(component, u, 1), -3 + 2 + 0.5 + 8);
  std::vector<std::uint32_t> slots;
  for_each_slot(component, 0, [&](std::uint32_t slot) { slots.push_back(slot); });
  EXPECT_THAT(slots, ElementsAre(1, 5));
}

TEST(Cutter, DropsDimensionsAndRenumbersIndices) {
  ProblemBuilder builder({3, 2, 3, 4});
  builder.add_arc({1, 1, 0, 1}, -1);
  builder.add_arc({3, 0, 2, 0}, -2);
  builder.add_arc({3, 0, 3, 4}, -3);
  builder.add_arc({3, 0, 0, 0}, 10);
  const Problem problem = std::move(builder).build();
  const std::vector<ArcId> arcs = {1, 2};
  const Component cut = Cutter().cut(problem, make_shift(problem), arcs);
  EXPECT_THAT(cut.sizes, ElementsAre(1, 2, 1));
  EXPECT_THAT(cut.dimensions, ElementsAre(0, 2, 3));
  EXPECT_THAT(cut.origin, ElementsAre(0, 3, 0, 2, 3, 0, 4));
  EXPECT_THAT(tuples_of(cut), ElementsAre(Tuple{1, 1, 0}, Tuple{1, 2, 1}));
  EXPECT_THAT(cut.costs, ElementsAre(-12, -13));
  EXPECT_THAT(cut.arc_origin, ElementsAre(1, 2));
}

TEST(Cutter, CutsNothingOutOfAnything) {
  const Component cut = Cutter().cut(support::random_component(1), std::vector<ArcId>{});
  EXPECT_EQ(cut.num_dimensions(), 0);
  EXPECT_EQ(cut.num_slots(), 0u);
  EXPECT_EQ(cut.num_arcs(), 0u);
}

TEST(Cutter, KeepsTuplesAndShiftedCostsOfRandomProblems) {
  Cutter cutter;  // one for all: its scratch memory must not leak from cut to cut
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    const Problem& problem = random_case.problem;
    const Shift shift = make_shift(problem);
    Random random(seed);
    const std::vector<ArcId> arcs = random_subset(random, problem.num_arcs(), 0.5);
    const Component cut = cutter.cut(problem, shift, arcs);
    expect_consistent(cut);
    expect_no_unused_index(cut);
    ASSERT_EQ(cut.arc_origin, arcs);
    for (ArcId a = 0; a < arcs.size(); ++a) {
      EXPECT_EQ(tuple_in_problem(cut, a, problem.sizes().size()), problem.arc(arcs[a]));
      EXPECT_EQ(cut.costs[a], shifted_cost(problem, shift, arcs[a]));
      EXPECT_EQ(original_arc(cut, a), arcs[a]);
    }
  }
}

TEST(Cutter, CarriesOriginsThroughTwoCuts) {
  Cutter cutter;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    const Problem& problem = random_case.problem;
    Random random(seed);
    const std::vector<ArcId> first = random_subset(random, problem.num_arcs(), 0.8);
    const Component outer = cutter.cut(problem, make_shift(problem), first);
    const std::vector<ArcId> second = random_subset(random, outer.num_arcs(), 0.5);
    const Component inner = cutter.cut(outer, second);
    expect_consistent(inner);
    expect_no_unused_index(inner);
    for (ArcId a = 0; a < second.size(); ++a) {
      EXPECT_EQ(original_arc(inner, a), first[second[a]]);
      EXPECT_EQ(tuple_in_problem(inner, a, problem.sizes().size()), problem.arc(first[second[a]]));
      EXPECT_EQ(inner.costs[a], outer.costs[second[a]]);
    }
  }
}

TEST(Cutter, CountsArcsFromTheFirstComponentThatWasCut) {
  Cutter cutter;
  const Component whole = support::random_component(3);
  const Component outer = cutter.cut(whole, std::vector<ArcId>{1, 3, 4, 6});
  const Component inner = cutter.cut(outer, std::vector<ArcId>{0, 2});
  EXPECT_EQ(original_arc(whole, 5), 5u);
  EXPECT_THAT(inner.arc_origin, ElementsAre(1, 4));
}

TEST(ArcsFromOriginal, InvertsOriginalArc) {
  const Component whole = support::random_component(3);
  const Component cut = Cutter().cut(whole, std::vector<ArcId>{1, 3, 4, 6});
  EXPECT_THAT(arcs_from_original(cut, {6, 1, 4}), ElementsAre(0, 2, 3));
  EXPECT_THAT(arcs_from_original(whole, {6, 1, 4}), ElementsAre(1, 4, 6));
  EXPECT_THAT(arcs_from_original(cut, {}), IsEmpty());
}

TEST(ArcsFromPart, NamesThemAsTheWholeDoes) {
  Cutter cutter;
  const Component whole = support::random_component(3);
  const Component outer = cutter.cut(whole, std::vector<ArcId>{1, 3, 4, 6});
  const Component inner = cutter.cut(outer, std::vector<ArcId>{0, 2});
  EXPECT_THAT(arcs_from_part(outer, inner, {1, 0}), ElementsAre(0, 2));
  EXPECT_THAT(arcs_from_part(whole, inner, {1, 0}), ElementsAre(1, 4));
  EXPECT_THAT(arcs_from_part(whole, whole, {5, 2}), ElementsAre(2, 5));
}

TEST(RestrictSlots, FollowsTheOriginOfEverySlot) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Component whole = support::random_component_of_any_kind(seed);
    Cutter cutter;
    const Component outer = cutter.cut(whole, random_subset(random, whole.num_arcs(), 0.8));
    const Component inner = cutter.cut(outer, random_subset(random, outer.num_arcs(), 0.5));
    std::vector<double> values(whole.num_slots());
    for (std::uint32_t slot = 0; slot < values.size(); ++slot) values[slot] = -1.0 - slot;
    for (const std::uint32_t dummy : whole.offset) values[dummy] = 0;
    const std::vector<double> once = restrict_slots(whole, values, outer);
    const std::vector<double> direct = restrict_slots(whole, values, inner);
    EXPECT_EQ(restrict_slots(outer, once, inner), direct);
    std::vector<double> extended(whole.num_slots(), 7.0);
    extend_slots(outer, once, whole, extended);
    EXPECT_EQ(restrict_slots(whole, extended, outer), once);
    const std::vector<std::uint32_t> numbers = slots_in_part(whole, outer);
    for (std::uint32_t slot = 0; slot < numbers.size(); ++slot) {
      const double value = numbers[slot] != 0 ? once[numbers[slot]] : values[slot];
      EXPECT_EQ(value, values[slot]);
    }
    EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 0u),
              static_cast<std::ptrdiff_t>(whole.num_slots() - outer.num_indices()));
    EXPECT_EQ(std::count(extended.begin(), extended.end(), 7.0),
              static_cast<std::ptrdiff_t>(whole.num_slots() - outer.num_indices()));
    ASSERT_EQ(direct.size(), inner.num_slots());
    for (std::size_t k = 0; k < inner.sizes.size(); ++k) {
      EXPECT_EQ(direct[inner.offset[k]], 0.0);
      for (Index i = 1; i <= inner.sizes[k]; ++i) {
        const std::uint32_t slot = inner.offset[k] + i;
        EXPECT_EQ(direct[slot], values[whole.offset[inner.dimensions[k]] + inner.origin[slot]]);
      }
    }
  }
}

}  // namespace
}  // namespace nda::core
