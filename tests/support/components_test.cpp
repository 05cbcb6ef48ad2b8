#include "support/components.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nda::support {
namespace {

using core::append_arc;
using core::Component;
using core::make_component;
using core::Packing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Component path() {
  Component component = make_component({1, 2, 1});
  append_arc(component, std::vector<Index>{0, 1, 1}, -2);
  append_arc(component, std::vector<Index>{1, 1, 0}, -3);
  append_arc(component, std::vector<Index>{1, 2, 0}, -4);
  return component;
}

TEST(WholeComponent, ShiftsEveryArc) {
  ProblemBuilder builder({1, 2});
  builder.add_arc({1, 0}, 5);
  builder.add_arc({1, 1}, 2);
  builder.add_arc({1, 2}, 9);
  builder.add_arc({0, 2}, 1);
  const Component component = whole_component(std::move(builder).build());
  EXPECT_THAT(component.costs, ElementsAre(-3, 3));
  EXPECT_THAT(component.indices[1], ElementsAre(1, 2));
}

TEST(ToProblem, IsTheInverse) {
  const Component component = random_component(7);
  const Component back = whole_component(to_problem(component));
  EXPECT_EQ(back.indices, component.indices);
  EXPECT_EQ(back.costs, component.costs);
}

TEST(PackingFault, SeesEveryKindOfFault) {
  EXPECT_THAT(packing_fault(path(), Packing{{0, 2}, -6}), IsEmpty());
  EXPECT_THAT(packing_fault(path(), Packing{{0, 2}, -5}), HasSubstr("states cost"));
  EXPECT_THAT(packing_fault(path(), Packing{{0, 1}, -5}), HasSubstr("dimension 2 is used twice"));
  EXPECT_THAT(packing_fault(path(), Packing{{0, 0}, -4}), HasSubstr("arc 0 is in twice"));
  EXPECT_THAT(packing_fault(path(), Packing{{3}, 0}), HasSubstr("does not exist"));
}

TEST(AllPackings, ListsTheIndependentSetsOfAPath) {
  std::vector<double> costs;
  for (const Packing& packing : all_packings(path())) costs.push_back(packing.cost);
  EXPECT_THAT(costs, ::testing::UnorderedElementsAre(0, -2, -3, -4, -6));
  EXPECT_EQ(best_cost(path()), -6);
}

TEST(MultiplierFault, SeesEveryKindOfFault) {
  // Slots: 0 1 | 2 3 4 | 5 6, the dummies being 0, 2 and 5.
  EXPECT_THAT(multiplier_fault(path(), std::vector<double>{0, -4, 0, -2, 0, 0, 0}), IsEmpty());
  EXPECT_THAT(multiplier_fault(path(), std::vector<double>{0, -3, 0, -2, 0, 0, 0}),
              HasSubstr("reduced cost of arc 2"));
  EXPECT_THAT(multiplier_fault(path(), std::vector<double>{0, -5, 0, -3, 1, 0, 0}),
              HasSubstr("slot 4 is positive"));
  EXPECT_THAT(multiplier_fault(path(), std::vector<double>{0, -4, -1, -2, 0, 0, 0}),
              HasSubstr("dummy 2"));
  EXPECT_THAT(multiplier_fault(path(), std::vector<double>{0}), HasSubstr("1 multipliers"));
}

TEST(FeasibleMultipliers, AreFeasible) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = random_component_of_any_kind(seed);
    core::Random random(seed);
    const std::vector<double> u =
        feasible_multipliers(component, random, 0.1 * static_cast<double>(seed % 3));
    EXPECT_THAT(multiplier_fault(component, u), IsEmpty());
    EXPECT_LE(sum_of(u), best_cost(component) + 1e-9);
  }
}

}  // namespace
}  // namespace nda::support
