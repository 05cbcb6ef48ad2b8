#include "core/permuted.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/random.hpp"
#include "support/components.hpp"

namespace nda::core {
namespace {

std::vector<std::size_t> random_order(const Component& component, Random& random) {
  std::vector<std::size_t> order(component.sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  shuffle(order, random);
  return order;
}

std::vector<Index> tuple(const Component& component, ArcId a) {
  std::vector<Index> indices;
  for (int k = 0; k < component.num_dimensions(); ++k) indices.push_back(component.index(k, a));
  return indices;
}

TEST(Permuted, HasTheSamePackingsInLexicographicOrder) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Component source = support::random_component_of_any_kind(seed);
    const Permuted permuted(source, random_order(source, random));
    const Component& component = permuted.component();
    for (ArcId a = 1; a < component.num_arcs(); ++a)
      EXPECT_LT(tuple(component, a - 1), tuple(component, a));
    EXPECT_NEAR(support::best_cost(component), support::best_cost(source), 1e-9);
  }
}

TEST(Permuted, LeadsBackToTheSource) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Component source = support::random_component_of_any_kind(seed);
    const std::vector<std::size_t> order = random_order(source, random);
    const Permuted permuted(source, order);
    const Component& component = permuted.component();
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      const Packing packing = permuted.to_source({{a}, component.costs[a]});
      ASSERT_EQ(packing.arcs.size(), 1u);
      EXPECT_EQ(packing.cost, component.costs[a]);
      for (std::size_t k = 0; k < order.size(); ++k)
        EXPECT_EQ(component.indices[k][a], source.indices[order[k]][packing.arcs.front()]);
    }
    const std::vector<double> u = support::feasible_multipliers(source, random);
    const std::vector<double> own = permuted.from_source(u);
    EXPECT_EQ(support::multiplier_fault(component, own), "");
    EXPECT_EQ(permuted.to_source(own), u);
    EXPECT_TRUE(permuted.to_source(std::span<const double>()).empty());
  }
}

TEST(Permuted, IsTheSourceWhereNothingMoves) {
  const Component source = support::random_component(1);
  EXPECT_EQ(&Permuted(source, {0, 1, 2}).component(), &source);
}

}  // namespace
}  // namespace nda::core
