#include "core/reduced_costs.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "support/components.hpp"

namespace nda::core {
namespace {

Component component_of(int num_dimensions, std::uint64_t seed) {
  support::RandomComponentOptions options;
  options.sizes.assign(static_cast<std::size_t>(num_dimensions), 7);
  options.sizes.back() = 400;
  options.num_arcs = 3 * static_cast<int>(kReducedBlock);
  return support::random_component(seed, options);
}

std::vector<double> random_multipliers(const Component& component, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> u(component.num_slots());
  for (double& multiplier : u) multiplier = random.uniform(-5, 5);
  return u;
}

// Subtracted one after the other: any other order gives other bits.
double subtract_in_order(const Component& component,
                         std::span<const double> u,
                         ArcId a,
                         int from_dimension) {
  double r = component.costs[a];
  for (int k = from_dimension; k < component.num_dimensions(); ++k) r -= u[component.slot(k, a)];
  return r;
}

// Every number of terms of one round, and several rounds.
class ReducedCosts : public ::testing::TestWithParam<int> {};

TEST_P(ReducedCosts, HaveTheBitsOfSubtractionInOrder) {
  const Component component = component_of(GetParam(), 1);
  const std::vector<double> u = random_multipliers(component, 2);
  for (int from = 0; from <= GetParam(); ++from) {
    const ArcId first = static_cast<ArcId>(from);
    std::vector<double> r(component.num_arcs() - first);
    reduced_costs(component, u, first, r, from);
    for (std::size_t n = 0; n < r.size(); ++n) {
      const ArcId a = first + static_cast<ArcId>(n);
      ASSERT_EQ(r[n], subtract_in_order(component, u, a, from)) << "arc " << a << " from " << from;
    }
  }
}

TEST_P(ReducedCosts, AreVisitedArcByArc) {
  const Component component = component_of(GetParam(), 3);
  const std::vector<double> u = random_multipliers(component, 4);
  ArcId next = 0;
  EXPECT_TRUE(for_each_reduced_cost(component, u, {}, [&](ArcId a, double r) {
    EXPECT_EQ(a, next++);
    EXPECT_EQ(r, reduced_cost(component, u, a));
  }));
  EXPECT_EQ(next, component.num_arcs());
}

INSTANTIATE_TEST_SUITE_P(Dimensions, ReducedCosts, ::testing::Range(2, 18));

TEST(ReducedCosts, AreNotVisitedAfterTheDeadline) {
  const Component component = component_of(3, 5);
  const std::vector<double> u(component.num_slots());
  EXPECT_FALSE(for_each_reduced_cost(
      component, u, Deadline(0), [](ArcId, double) { FAIL() << "no time to visit it"; }));
}

}  // namespace
}  // namespace nda::core
