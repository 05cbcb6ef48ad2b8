#include "bounded/branch_and_bound.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bounded/bound.hpp"
#include "bounded/cut_pool.hpp"
#include "bounded_parts.hpp"

namespace nda::bounded {
namespace {

SearchLimits limits_of(double margin) {
  SearchLimits limits;
  limits.margin = margin;
  limits.max_nodes = std::numeric_limits<std::int64_t>::max();
  return limits;
}

SearchResult search(const BoundedComponent& part, const SearchLimits& limits) {
  const std::vector<double> nothing(part.rows.size(), 0.0);
  return branch_and_bound(part, make_choice(part, {}), nothing, limits, {});
}

TEST(BoundedBranchAndBound, FindsTheLeastCost) {
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 3 + static_cast<int>(seed % 3), 12)) {
      const double least = least_cost(part);
      const SearchResult found = search(part, limits_of(1e-9));
      EXPECT_EQ(found.end, SearchEnd::kComplete);
      EXPECT_NEAR(found.best.cost, least, 1e-8);
      EXPECT_LE(found.lower, least + 1e-9);
      EXPECT_GE(found.lower, least - 1e-8);
      EXPECT_LE(found.certificate, least + 1e-9);
      EXPECT_NEAR(lagrangian_bound(part, found.u), found.certificate, 1e-12);
    }
  }
}

TEST(BoundedBranchAndBound, KeepsItsBoundAtEveryLimit) {
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 4, 12)) {
      const double least = least_cost(part);
      for (const std::int64_t nodes : {0, 1, 2, 5}) {
        SearchLimits limits = limits_of(1e-9);
        limits.max_nodes = nodes;
        const SearchResult found = search(part, limits);
        EXPECT_LE(found.nodes, nodes);
        EXPECT_LE(found.lower, least + 1e-9);
        EXPECT_GE(found.best.cost, least - 1e-9);
        stopped += found.end == SearchEnd::kNodes ? 1 : 0;
      }
    }
  }
  EXPECT_GT(stopped, 10);
}

// Cuts at the point of the linear program: no choice breaks one, and their prices are bounds.
TEST(CutPool, HoldsForEveryChoice) {
  int cuts = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    for (const BoundedComponent& part : random_parts(seed, 3 + static_cast<int>(seed % 2), 12)) {
      const std::vector<core::ArcId> arcs = core::all_arcs(part.graph);
      RelaxedProgram program(part);
      program.add_arcs(arcs);
      ASSERT_EQ(program.solve_primal({}), lp::Outcome::kOptimal);
      CutPool pool(part, arcs);
      if (pool.separate(program, {}) == 0) continue;
      ++cuts;
      ASSERT_EQ(program.solve_dual({}, kInfinity), lp::Outcome::kOptimal);
      const double bound = lagrangian_bound(part, program.multipliers(), {}, pool.prices(program));
      EXPECT_LE(bound, least_cost(part) + 1e-9);
    }
  }
  EXPECT_GT(cuts, 5);
}

}  // namespace
}  // namespace nda::bounded
