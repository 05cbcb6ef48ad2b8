#include "rows/cut_dual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cutting/cut_bound.hpp"
#include "cutting/cutting_support.hpp"
#include "dual/maximize.hpp"
#include "rows/rows_support.hpp"
#include "support/components.hpp"

namespace nda::rows {
namespace {

using core::Component;
using cutting::CutRow;
using cutting::fractional_component;
using cutting::triangle;

constexpr double kTie = 1e-9;

struct Evaluation {
  double value;
  std::vector<double> subgradient;
};

Evaluation evaluate(CutDual& function, std::span<const double> point) {
  Evaluation at{0, std::vector<double>(point.size())};
  at.value = function.evaluate(point, at.subgradient);
  return at;
}

// Multipliers of any sign, some exactly 0, those of dummies all.
std::vector<double> random_point(const Component& component,
                                 const CutDual& function,
                                 core::Random& random) {
  std::vector<double> point(function.num_variables());
  for (double& multiplier : point) multiplier = random.below(4) == 0 ? 0.0 : random.uniform(-12, 4);
  for (const std::uint32_t dummy : component.offset) {
    if (dummy >= function.first_slot()) point[dummy - function.first_slot()] = 0;
  }
  return point;
}

// Each pair of three indices at -1.  Two of them exclude each other, so the optimum is -1; half of
// each costs -1.5, and no multipliers of indices prove more.  The one clique there is closes the
// gap: its multiplier -1 makes all costs 0, and q(0, -1) = -1.
TEST(CutDual, ClosesTheGapOfTheTriangleByOneClique) {
  const Component component = triangle();
  CutDual function(component);
  double plain = -kInfinity;
  for (double u = -3; u <= 1; u += 0.125)
    plain = std::max(plain, evaluate(function, std::vector<double>{0, u}).value);
  EXPECT_EQ(plain, -1.5);
  const std::vector<CutRow> rows = {row_of(component, {{1, 3, 5}, {1, 1, 1}, 2})};
  function.set_rows(rows);
  ASSERT_EQ(function.num_variables(), 3u);
  EXPECT_EQ(evaluate(function, std::vector<double>{0, 0, -1}).value, -1);
}

template <typename Check>
void for_random_points(std::uint64_t num_components, Check&& check) {
  for (std::uint64_t seed = 0; seed < num_components; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Component component =
        seed % 2 == 0 ? support::random_component_of_any_kind(seed) : fractional_component(seed);
    const std::vector<CutRow> rows = random_rows(component, 1 + random.below(8), random);
    CutDual function(component);
    function.set_rows(rows);
    for (int n = 0; n < 4; ++n)
      check(component, function, random_point(component, function, random), random);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(CutDual, NeverExceedsTheOptimumWhateverTheMultipliers) {
  for_random_points(2000, [](const Component& component, CutDual& function, auto point, auto&) {
    EXPECT_LE(evaluate(function, point).value, support::best_cost(component) + kTie);
  });
}

TEST(CutDual, HasPlanesThatAreNowhereBelow) {
  for_random_points(1000, [](const Component& component, CutDual& function, auto u, auto& random) {
    const Evaluation at_u = evaluate(function, u);
    const std::vector<double> w = random_point(component, function, random);
    double plane = at_u.value;
    std::vector<double> middle(u.size());
    for (std::size_t j = 0; j < u.size(); ++j) {
      plane += at_u.subgradient[j] * (w[j] - u[j]);
      middle[j] = (u[j] + w[j]) / 2;
    }
    const double at_w = evaluate(function, w).value;
    EXPECT_LE(at_w, plane + kTie);
    EXPECT_GE(evaluate(function, middle).value, (at_u.value + at_w) / 2 - kTie);
  });
}

// Right side minus uses where the multiplier is negative.
TEST(CutDual, CountsUsesOfCuts) {
  for_random_points(500, [](const Component& component, CutDual& function, auto point, auto&) {
    const std::size_t first = function.num_indices_relaxed();
    const Evaluation at = evaluate(function, point);
    for (std::size_t c = 0; c < function.rows().size(); ++c) {
      double uses = 0;
      for (const core::ArcId a : function.chosen_arcs()) {
        int weight = 0;
        const cutting::Cut& cut = function.rows()[c].cut;
        core::for_each_slot(component, a, [&](std::uint32_t slot) {
          for (std::size_t i = 0; i < cut.slots.size(); ++i)
            weight += cut.slots[i] == slot ? cut.weights[i] : 0;
        });
        uses += weight / cut.divisor;
      }
      const double left = function.rows()[c].cut.right_side() - uses;
      if (point[first + c] < 0) {
        EXPECT_EQ(at.subgradient[first + c], left);
      } else if (point[first + c] > 0) {
        EXPECT_EQ(at.subgradient[first + c], -uses);
      } else {
        EXPECT_EQ(at.subgradient[first + c], std::min(0.0, left));
      }
    }
  });
}

TEST(CutDual, IsTheDualFunctionWhereCutsHaveNoMultiplier) {
  for_random_points(500, [](const Component& component, CutDual& function, auto point, auto&) {
    const double charged = evaluate(function, point).value;
    std::vector<double> without = point;
    std::fill(without.begin() + static_cast<std::ptrdiff_t>(function.num_indices_relaxed()),
              without.end(),
              0.0);
    relax::DualFunction plain(component);
    std::vector<double> subgradient(plain.num_variables());
    EXPECT_EQ(evaluate(function, without).value,
              plain.evaluate(std::span(without).first(plain.num_variables()), subgradient));
    EXPECT_EQ(evaluate(function, point).value, charged) << "depends on what came before";
  });
}

TEST(CutDual, CertifiesItsValueOrMoreButNotTooMuch) {
  for_random_points(1500, [](const Component& component, CutDual& function, auto point, auto&) {
    const double value = evaluate(function, point).value;
    std::vector<double> u(component.num_slots());
    std::vector<double> of_rows(function.rows().size());
    ASSERT_TRUE(function.certify(u, of_rows, {}));
    std::vector<CutRow> rows(function.rows().begin(), function.rows().end());
    for (std::size_t c = 0; c < rows.size(); ++c) rows[c].multiplier = of_rows[c];
    std::vector<double> reduced(component.num_arcs());
    const double lower = cutting::price(component, core::all_arcs(component), u, rows, {}, reduced);
    EXPECT_GE(lower, value - kTie);
    EXPECT_LE(lower, support::best_cost(component) + kTie);
    EXPECT_THAT(of_rows, ::testing::Each(::testing::Le(0.0)));
    EXPECT_THAT(u, ::testing::Each(::testing::Le(0.0)));
    EXPECT_THAT(reduced, ::testing::Each(::testing::Ge(-kTie)));
  });
}

/// What all dual methods owe their caller, on this function.
class CutDualMethods : public ::testing::TestWithParam<DualMethod> {
 protected:
  dual::MaximizeResult run(CutDual& function, int evaluations) {
    dual::MaximizeOptions options;
    options.max_evaluations = evaluations;
    const std::vector<double> start(function.num_variables(), 0.0);
    return dual::maximize(GetParam(), function, start, options);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods,
                         CutDualMethods,
                         ::testing::Values(DualMethod::kBundleTrust,
                                           DualMethod::kSubgradient,
                                           DualMethod::kVolume));

TEST_P(CutDualMethods, NeverExceedTheOptimumAndReturnThePointOfTheirValue) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    const std::vector<CutRow> rows = all_cliques(component);
    CutDual function(component);
    function.set_rows(rows);
    const dual::MaximizeResult result = run(function, 60);
    EXPECT_LE(result.value, support::best_cost(component) + kTie);
    EXPECT_EQ(evaluate(function, result.point).value, result.value);
  }
}

TEST_P(CutDualMethods, TakeTheSameStepsTwice) {
  const Component component = fractional_component(4);
  const std::vector<CutRow> rows = all_cliques(component);
  CutDual one(component);
  CutDual other(component);
  one.set_rows(rows);
  other.set_rows(rows);
  EXPECT_EQ(run(one, 100).point, run(other, 100).point);
}

// With cuts the maximum is at least what it is without, and over many problems clearly more.
TEST_P(CutDualMethods, GainByCuts) {
  double with = 0;
  double without = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Component component = fractional_component(seed);
    const std::vector<CutRow> rows = all_cliques(component);
    CutDual function(component);
    const double best = support::best_cost(component);
    without += best - run(function, 400).value;
    function.set_rows(rows);
    with += best - run(function, 400).value;
  }
  EXPECT_LT(with, 0.7 * without);
}

TEST_P(CutDualMethods, ReachTheOptimumOfTheTriangle) {
  const Component component = triangle();
  const std::vector<CutRow> rows = all_cliques(component);
  CutDual function(component);
  function.set_rows(rows);
  EXPECT_NEAR(run(function, 400).value, -1, 1e-3);
}

}  // namespace
}  // namespace nda::rows
