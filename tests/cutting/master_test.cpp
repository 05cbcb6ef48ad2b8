#include "cutting/master.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;
using lp::Outcome;

const core::Deadline kNever;

TEST(Master, RelaxesTheTriangleThenCutsIt) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), -1.5, 1e-9);
  master.add({{1, 3, 5}, {1, 1, 1}, 2});
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), -1, 1e-9);
  EXPECT_NEAR(master.cuts()[0].multiplier, -1, 1e-9);
}

TEST(Master, ForbidsAndForces) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  const std::vector<ArcId> first = {0};
  master.forbid(first);
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), -1, 1e-9);
  const std::vector<ArcId> others = {1, 2};
  master.forbid(others);
  master.force(1);  // nothing can cover it: that costs twice the dearest arc
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), 2, 1e-9);
  master.release(1);
  master.allow(others);
  master.allow(first);
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), -1.5, 1e-9);
}

// The bound by its definition, from u() and cuts() alone.
double bound_of(const Component& component, const Master& master) {
  double bound = 0;
  for (const double u : master.u()) bound += u;
  for (const CutRow& row : master.cuts()) bound += row.multiplier * row.cut.right_side();
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    double r = core::reduced_cost(component, master.u(), a);
    for (const CutRow& row : master.cuts()) {
      for (const CutEntry& entry : row.entries) {
        if (entry.arc == a) r -= row.multiplier * entry.coefficient;
      }
    }
    bound += std::min(0.0, r);
  }
  return bound;
}

TEST(Master, IsABoundThatItsMultipliersProve) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const Component component = fractional_component(seed);
    core::Random random(seed);
    const std::vector<double> start = support::feasible_multipliers(component, random);
    Master master(component, all_arcs(component), start);
    ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
    const double relaxed = master.lower();
    const double best = support::best_cost(component);
    ASSERT_LE(relaxed, best + 1e-9) << "seed " << seed;
    ASSERT_GE(relaxed, support::sum_of(start) - 1e-7) << "seed " << seed;
    ASSERT_NEAR(relaxed, bound_of(component, master), 1e-9) << "seed " << seed;
    for (const double u : master.u()) ASSERT_LE(u, 0);
  }
}

// Column generation ends at the same value as having all columns from the start.
TEST(Master, ColumnGenerationReachesTheOptimum) {
  support::RandomComponentOptions options;
  options.sizes = {12, 12, 12, 12};
  options.num_arcs = 9000;
  options.dummy_share = 0.1;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Component component = support::random_component(seed, options);
    Master few(component, all_arcs(component), no_multipliers(component));
    const std::size_t at_first = few.arcs().size();
    ASSERT_LT(at_first, component.num_arcs());
    ASSERT_EQ(few.solve(kInfinity, kNever), Outcome::kOptimal);
    EXPECT_GT(few.arcs().size(), at_first);
    lp::LinearProgram all;
    all.add_empty_rows(static_cast<int>(component.num_slots()));
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      std::vector<int> rows;
      core::for_each_slot(
          component, a, [&](std::uint32_t slot) { rows.push_back(static_cast<int>(slot)); });
      const std::vector<double> ones(rows.size(), 1.0);
      all.add_column({rows, ones}, component.costs[a], kInfinity);
    }
    ASSERT_EQ(all.solve_primal(kNever), Outcome::kOptimal);
    EXPECT_NEAR(few.lower(), all.objective(), 1e-6);
  }
}

TEST(Master, FixingKeepsEveryPackingBelowTheCutoff) {
  int num_fixed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = fractional_component(seed);
    const double cutoff = support::best_cost(component) + 0.5;
    Master master(component, all_arcs(component), no_multipliers(component));
    ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
    master.fix(cutoff);
    std::vector<bool> live(component.num_arcs(), false);
    for (const ArcId a : master.live()) live[a] = true;
    num_fixed += static_cast<int>(component.num_arcs() - master.live().size());
    for (const core::Packing& packing : support::all_packings(component)) {
      if (packing.cost >= cutoff - 1e-9) continue;
      for (const ArcId a : packing.arcs) ASSERT_TRUE(live[a]) << "seed " << seed << " arc " << a;
    }
    ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
    ASSERT_LE(master.lower(), cutoff - 0.5 + 1e-9);
  }
  EXPECT_GT(num_fixed, 1000);
}

TEST(Master, DropsCutsThatStayIdle) {
  const Component component = triangle();
  Master master(component, all_arcs(component), no_multipliers(component));
  master.add({{1, 3, 5}, {1, 1, 1}, 2});
  master.add({{1, 3, 5}, {1, 1, 1}, 3});  // of no arc
  for (int solve = 0; solve < 3; ++solve) {
    ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  }
  master.drop_idle(1);
  EXPECT_EQ(master.cuts().size(), 1u);
  ASSERT_EQ(master.solve(kInfinity, kNever), Outcome::kOptimal);
  EXPECT_NEAR(master.lower(), -1, 1e-9);
}

}  // namespace
}  // namespace nda::cutting
