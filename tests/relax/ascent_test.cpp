#include "relax/ascent.hpp"

#include <gtest/gtest.h>

#include "relax/dual_function.hpp"
#include "relax/separable_dual.hpp"
#include "support/components.hpp"

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;

std::vector<double> random_start(const Component& component, core::Random& random) {
  std::vector<double> u(component.num_slots());
  for (double& value : u) value = random.uniform(-8, 0);
  for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
  return u;
}

template <typename Check>
void for_random_components(Check&& check) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    core::Random random(seed);
    check(component, random_start(component, random), random);
  }
}

void expect_feasible(const Component& component, const Ascent& ascent) {
  for (const double u : ascent.u()) EXPECT_LE(u, 0);
  for (ArcId a = 0; a < component.num_arcs(); ++a)
    EXPECT_GE(core::reduced_cost(component, ascent.u(), a), -1e-9);
  EXPECT_LE(ascent.bound(), support::best_cost(component) + 1e-9);
}

TEST(Ascent, KeepsReducedCostsUpToDate) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, std::move(u));
    ascent.sweep();
    ascent.tighten();
    ascent.sweep();
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      EXPECT_NEAR(ascent.reduced_costs()[a], core::reduced_cost(component, ascent.u(), a), 1e-9);
    }
  });
}

TEST(Ascent, SweepsAsTheSeparableDualDoes) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, u);
    ascent.sweep();
    SeparableDual function(component);
    for (std::size_t k = function.num_blocks(); k-- > 0;) function.ascend(k, u);
    for (std::size_t slot = 0; slot < u.size(); ++slot)
      EXPECT_NEAR(ascent.u()[slot], u[slot], 1e-9);
  });
}

TEST(Ascent, TightensAsMakeFeasibleDoes) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, u);
    ascent.tighten();
    expect_feasible(component, ascent);
    EXPECT_NEAR(ascent.bound(), make_feasible(component, u, {}), 1e-9);
  });
}

TEST(Ascent, TightensMarkedIndicesOnly) {
  for_random_components(
      [](const Component& component, std::vector<double> u, core::Random& random) {
        std::vector<char> marked(u.size());
        for (char& mark : marked) mark = static_cast<char>(random.below(2));
        Ascent ascent(component, u);
        ascent.tighten(marked);
        for (std::size_t slot = 0; slot < u.size(); ++slot) {
          EXPECT_TRUE(marked[slot] || ascent.u()[slot] == u[slot]);
        }
      });
}

TEST(Ascent, RepairsWhateverIsViolated) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, std::move(u));
    ascent.repair();
    expect_feasible(component, ascent);
  });
}

}  // namespace
}  // namespace nda::relax
