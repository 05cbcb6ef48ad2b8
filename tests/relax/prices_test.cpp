#include "relax/prices.hpp"

#include <gtest/gtest.h>

#include "support/components.hpp"

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;

template <typename Check>
void for_random_prices(Check&& check) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    core::Random random(seed);
    std::vector<double> u(component.num_slots());
    for (double& value : u) value = random.uniform(-8, 0);
    for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
    check(component, Prices(component, u), random);
  }
}

void expect_up_to_date(const Component& component, const Prices& prices) {
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    EXPECT_NEAR(prices.reduced_costs()[a], core::reduced_cost(component, prices.u(), a), 1e-9);
  }
}

void expect_feasible(const Component& component, const Prices& prices) {
  for (const double u : prices.u()) EXPECT_LE(u, 0);
  for (const double r : prices.reduced_costs()) EXPECT_GE(r, -1e-9);
  EXPECT_LE(prices.bound(), support::best_cost(component) + 1e-9);
}

TEST(Prices, OfAllIndicesTightenedAreFeasible) {
  for_random_prices([](const Component& component, Prices prices, core::Random&) {
    prices.tighten(std::vector<char>(component.num_slots(), 1));
    expect_up_to_date(component, prices);
    expect_feasible(component, prices);
  });
}

TEST(Prices, TightenMarkedIndicesOnly) {
  for_random_prices([](const Component& component, Prices prices, core::Random& random) {
    std::vector<char> marked(component.num_slots());
    for (char& mark : marked) mark = static_cast<char>(random.below(2));
    const std::vector<double> before = prices.u();
    prices.tighten(marked);
    expect_up_to_date(component, prices);
    for (std::size_t slot = 0; slot < before.size(); ++slot)
      EXPECT_TRUE(marked[slot] || prices.u()[slot] == before[slot]);
  });
}

TEST(Prices, RepairWhateverIsViolated) {
  for_random_prices([](const Component& component, Prices prices, core::Random&) {
    prices.repair();
    expect_up_to_date(component, prices);
    expect_feasible(component, prices);
  });
}

}  // namespace
}  // namespace nda::relax
