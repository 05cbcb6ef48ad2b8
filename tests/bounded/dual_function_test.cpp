#include "bounded/dual_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bounded/bound.hpp"
#include "bounded/separable_dual.hpp"
#include "bounded_parts.hpp"
#include "dual/maximize.hpp"

namespace nda::bounded {
namespace {

// q(w) <= q(u) + g (w - u), and q <= optimum, at random points.
void expect_dual(const BoundedComponent& part,
                 dual::ConcaveFunction& function,
                 std::size_t first,
                 core::Random& random) {
  const double least = least_cost(part);
  const auto point = [&] {
    const std::vector<double> all = random_multipliers(part, random);
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
  };
  const std::vector<double> u = point();
  const std::vector<double> w = point();
  std::vector<double> at_u(u.size());
  std::vector<double> at_w(u.size());
  const double of_u = function.evaluate(u, at_u);
  const double of_w = function.evaluate(w, at_w);
  EXPECT_LE(of_u, least + 1e-9);
  double line = of_u;
  for (std::size_t j = 0; j < u.size(); ++j) line += at_u[j] * (w[j] - u[j]);
  EXPECT_LE(of_w, line + 1e-9);
}

TEST(BoundedDual, IsABoundWithSubgradients) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    for (const BoundedComponent& part : random_parts(seed, 3 + static_cast<int>(seed % 3), 11)) {
      DualFunction kept(part);
      expect_dual(part, kept, kept.first_slot(), random);
      SeparableDual separable(part);
      expect_dual(part, separable, 0, random);
    }
  }
}

TEST(BoundedDual, IsTheOptimumInTwoDimensions) {
  int parts = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 2, 14)) {
      ++parts;
      DualFunction function(part);
      std::vector<double> none;
      const double least = least_cost(part);
      EXPECT_NEAR(function.evaluate(none, none), least, 1e-9);
      const auto arcs = function.chosen_arcs();
      EXPECT_NEAR(make_choice(part, {arcs.begin(), arcs.end()}).cost, least, 1e-9);
    }
  }
  EXPECT_GT(parts, 100);
}

// The flow's duals prove what it says, at any point, where no cell is used twice.
TEST(BoundedDual, MultipliersProveTheValue) {
  int exact = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    for (const BoundedComponent& part : random_parts(seed, 3, 14)) {
      DualFunction function(part);
      std::vector<double> all = random_multipliers(part, random);
      const std::vector<double> u(all.begin() + function.first_slot(), all.end());
      std::vector<double> subgradient(u.size());
      const double value = function.evaluate(u, subgradient);
      function.multipliers(all);
      const double bound = lagrangian_bound(part, all);
      EXPECT_LE(bound, value + 1e-8);
      const bool is_once = std::all_of(part.rows.begin(),
                                       part.rows.begin() + function.first_slot(),
                                       [](const Row& row) { return row.hi <= 1; });
      if (!is_once) continue;
      ++exact;
      EXPECT_NEAR(bound, value, 1e-8);
    }
  }
  EXPECT_GT(exact, 20);
}

TEST(SeparableDual, AscendsToABound) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 3, 14)) {
      SeparableDual function(part);
      std::vector<double> u(part.rows.size(), 0.0);
      std::vector<double> subgradient(u.size());
      double before = function.evaluate(u, subgradient);
      for (int sweep = 0; sweep < 3; ++sweep) {
        for (std::size_t block = 0; block < function.num_blocks(); ++block) {
          const double gain = function.ascend(block, u);
          EXPECT_GE(gain, 0);
          const double after = function.evaluate(u, subgradient);
          EXPECT_NEAR(after, before + gain, 1e-8);
          before = after;
        }
      }
    }
  }
}

// With a complete bundle the maximum is that of the linear relaxation, as with all relaxed.
TEST(BoundedDual, BothReachTheSameMaximum) {
  int num_compared = 0;
  dual::MaximizeOptions options;
  options.max_evaluations = 400;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 3, 12)) {
      if (part.graph.num_dimensions() < 3) continue;
      ++num_compared;
      DualFunction kept(part);
      SeparableDual separable(part);
      const std::vector<double> few(kept.num_variables(), 0.0);
      const std::vector<double> all(separable.num_variables(), 0.0);
      const double one = dual::maximize_bundle_trust(kept, few, options).value;
      const double other = dual::maximize_bundle_trust(separable, all, options).value;
      EXPECT_NEAR(one, other, 1e-4 * (1 + std::abs(one)));
    }
  }
  EXPECT_GT(num_compared, 20);
}

}  // namespace
}  // namespace nda::bounded
