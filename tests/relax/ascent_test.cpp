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

std::vector<ArcId> random_arcs(const Component& component, core::Random& random) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (random.below(2)) arcs.push_back(a);
  }
  return arcs;
}

// Sweeps that leave out what sleeps move as all do.
TEST(Ascent, SweepsAsTheSeparableDualDoes) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, core::all_arcs(component), u);
    SeparableDual function(component);
    for (int sweep = 0; sweep < 6; ++sweep) {
      ascent.sweep();
      for (std::size_t k = function.num_blocks(); k-- > 0;) function.ascend(k, u);
      for (std::size_t slot = 0; slot < u.size(); ++slot)
        EXPECT_NEAR(ascent.u()[slot], u[slot], 1e-9);
    }
  });
}

TEST(Ascent, ClimbsUntilNothingMoves) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    SeparableDual function(component);
    std::vector<double> unused(u.size());
    const double before = function.evaluate(u, unused);
    Ascent ascent(component, core::all_arcs(component), u);
    ascent.climb(1000, 1e-6);
    EXPECT_GE(function.evaluate(ascent.u(), unused), before - 1e-9);
    Ascent again(component, core::all_arcs(component), ascent.u());
    EXPECT_LE(again.sweep(), 1e-5);
  });
}

TEST(Ascent, TightensAsMakeFeasibleDoes) {
  for_random_components([](const Component& component, std::vector<double> u, core::Random&) {
    Ascent ascent(component, core::all_arcs(component), u);
    ascent.tighten();
    EXPECT_NEAR(ascent.bound(), make_feasible(component, u, {}), 1e-9);
    for (std::size_t slot = 0; slot < u.size(); ++slot)
      EXPECT_NEAR(ascent.u()[slot], u[slot], 1e-9);
  });
}

TEST(Ascent, KnowsNoArcsButThoseListed) {
  for_random_components(
      [](const Component& component, std::vector<double> u, core::Random& random) {
        const std::vector<ArcId> arcs = random_arcs(component, random);
        Ascent ascent(component, arcs, std::move(u));
        ascent.climb(5, 0);
        ascent.tighten();
        for (const ArcId a : arcs) EXPECT_GE(core::reduced_cost(component, ascent.u(), a), -1e-9);
        if (arcs.empty()) return;
        const Component part = core::Cutter().cut(component, arcs);
        EXPECT_LE(ascent.bound(), support::best_cost(part) + 1e-9);
      });
}

}  // namespace
}  // namespace nda::relax
