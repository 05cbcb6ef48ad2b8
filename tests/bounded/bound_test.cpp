#include "bounded/bound.hpp"

#include <gtest/gtest.h>

#include "bounded_parts.hpp"

namespace nda::bounded {
namespace {

// Bounds 1..2, singleton 3: f = 3, 0, 0 for 0, 1, 2 uses.
Row one_or_two() {
  return {3, 1, 2, true, false};
}

TEST(Row, CostsWhatItLacks) {
  EXPECT_EQ(one_or_two().cost(0), 3);
  EXPECT_EQ(one_or_two().cost(1), 0);
  EXPECT_EQ(one_or_two().cost(2), 0);
}

TEST(Row, ValueIsTheLeastOfAllUses) {
  core::Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const auto lo = static_cast<Index>(random.below(4));
    const auto hi = lo + static_cast<Index>(random.below(3));
    const double single = lo == hi ? random.uniform(-5, 5) : random.uniform(0, 5);
    const Row row{single, lo, hi, false, false};
    for (const double u : {random.uniform(-6, 6), 0.0, single}) {
      double least = kInfinity;
      for (Index uses = 0; uses <= hi; ++uses) least = std::min(least, row.cost(uses) + u * uses);
      EXPECT_NEAR(row.value(u), least, 1e-12);
      for (Index uses = 0; uses <= hi + 1; ++uses) {
        const Index best = row.best_uses(u, uses);
        ASSERT_LE(best, hi);
        EXPECT_NEAR(row.cost(best) + u * best, least, 1e-12);
      }
    }
  }
}

TEST(Bound, HoldsForAnyMultipliers) {
  int parts = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    core::Random random(seed);
    for (const BoundedComponent& part : random_parts(seed, 2 + static_cast<int>(seed % 4), 10)) {
      ++parts;
      const double least = least_cost(part);
      for (int n = 0; n < 10; ++n) {
        std::vector<double> u = random_multipliers(part, random);
        const double bound = lagrangian_bound(part, u);
        EXPECT_LE(bound, least) << seed;
        clamp(part, u);
        EXPECT_GE(lagrangian_bound(part, u), bound - 1e-9) << seed;
      }
    }
  }
  EXPECT_GT(parts, 100);
}

// Of a branch: the choices that keep to what is decided.
TEST(Bound, HoldsForDecidedArcs) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    core::Random random(seed);
    for (const BoundedComponent& part : random_parts(seed, 3, 10)) {
      std::vector<Use> uses(part.num_arcs());
      for (Use& use : uses) use = static_cast<Use>(random.below(3));
      const double bound = lagrangian_bound(part, random_multipliers(part, random), uses);
      for_each_choice(part, [&](const Choice& choice) {
        bool fits = true;
        for (core::ArcId a = 0; a < part.num_arcs(); ++a) {
          const bool used = std::binary_search(choice.arcs.begin(), choice.arcs.end(), a);
          fits = fits && uses[a] != (used ? Use::kNever : Use::kAlways);
        }
        EXPECT_LE(bound, fits ? choice.cost + 1e-12 : kInfinity) << seed;
      });
    }
  }
}

}  // namespace
}  // namespace nda::bounded
