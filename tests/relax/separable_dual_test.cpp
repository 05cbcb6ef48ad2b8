#include "relax/separable_dual.hpp"

#include <gtest/gtest.h>

#include "support/components.hpp"

namespace nda::relax {
namespace {

using core::Component;

std::vector<double> random_point(const Component& component, core::Random& random) {
  std::vector<double> u(component.num_slots());
  for (double& value : u) value = random.uniform(-8, 4);
  for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
  return u;
}

double value_at(SeparableDual& function, const std::vector<double>& u) {
  std::vector<double> ignored(u.size());
  return function.evaluate(u, ignored);
}

TEST(SeparableDual, IsALowerBoundWithASupergradient) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    SeparableDual function(component);
    core::Random random(seed);
    const std::vector<double> u = random_point(component, random);
    std::vector<double> g(u.size());
    const double value = function.evaluate(u, g);
    EXPECT_LE(value, support::best_cost(component) + 1e-9);
    const std::vector<double> w = random_point(component, random);
    double linear = value;
    for (std::size_t slot = 0; slot < u.size(); ++slot) linear += g[slot] * (w[slot] - u[slot]);
    EXPECT_LE(value_at(function, w), linear + 1e-9);
  }
}

TEST(SeparableDual, AscendsByWhatItSaysToTheBestOfTheBlock) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    SeparableDual function(component);
    core::Random random(seed);
    std::vector<double> u = random_point(component, random);
    const std::size_t block = random.below(function.num_blocks());
    const double before = value_at(function, u);
    const double increase = function.ascend(block, u);
    const double after = value_at(function, u);
    EXPECT_NEAR(after - before, increase, 1e-9);
    const std::uint32_t first = component.offset[block];
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<double> other = u;
      for (Index i = 1; i <= component.sizes[block]; ++i) {
        other[first + i] += random.uniform(-3, 3);
      }
      EXPECT_LE(value_at(function, other), after + 1e-9) << "the block was not at its best";
    }
  }
}

}  // namespace
}  // namespace nda::relax
