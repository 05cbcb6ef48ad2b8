#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "support/rebuilt.hpp"

// How much is done, in counters: the traps that made earlier solvers slow, each with a problem that
// would show it (docs/testing.md lists them).

namespace nda {
namespace {

using support::rebuilt;
using support::sizes_of;
using support::Tuple;

// Whole numbers: one grid, whatever stands beside them.
Problem sparse_problem(Index size, std::size_t arcs, double scale, std::uint64_t seed) {
  PooreSparseOptions options;
  options.min_size = options.max_size = size;
  options.arcs = arcs;
  options.seed = seed;
  const Problem problem = generate_poore_sparse(options).problem;
  return rebuilt(problem, sizes_of(problem), [scale](Tuple&, double& cost) {
    cost = std::round(scale * cost);
  });
}

// The indices of each after those of the ones before it; singletons free.
Problem side_by_side(const std::vector<Problem>& problems) {
  std::vector<Index> sizes(problems.front().sizes().size(), 0);
  std::vector<std::pair<Tuple, double>> arcs;
  for (const Problem& problem : problems) {
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      Tuple tuple = problem.arc(a);
      for (std::size_t k = 0; k < tuple.size(); ++k) tuple[k] += tuple[k] == 0 ? 0 : sizes[k];
      arcs.emplace_back(std::move(tuple), problem.costs()[a]);
    }
    for (std::size_t k = 0; k < sizes.size(); ++k) sizes[k] += problem.sizes()[k];
  }
  ProblemBuilder builder(sizes);
  for (const auto& [tuple, cost] : arcs) builder.add_arc(tuple, cost);
  return std::move(builder).build();
}

// One component with a wide gap: bound and packing both take all they get.
Problem wide_problem() {
  return sparse_problem(12, 600, 1e3, 1);
}

Options limited(DualMethod method) {
  Options options;
  options.branch.max_nodes = 2000;
  options.relaxation.dual_method = method;
  return options;
}

TEST(Work, OfTheSearchForPackingsShows) {
  Options options = limited(DualMethod::kBundleTrust);
  const double found = solve(wide_problem(), options).cost;
  options.search.local_search = false;
  EXPECT_LT(found, solve(wide_problem(), options).cost);
}

// Fifty small components of costs a thousand times as large: no tolerance, step, search or budget
// of the first may follow them.
TEST(Work, OnAComponentIsTheSameBesideOthers) {
  const Problem alone = wide_problem();
  std::vector<Problem> others;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    others.push_back(sparse_problem(3, 20, 1e6, seed));
  const Problem rest = side_by_side(others);
  const Problem both = side_by_side({alone, rest});
  for (const DualMethod method : {DualMethod::kBundleTrust, DualMethod::kVolume}) {
    const Options options = limited(method);
    const Solution first = solve(alone, options);
    const Solution second = solve(rest, options);
    const Solution all = solve(both, options);
    ASSERT_EQ(first.components.size(), 1u);
    ASSERT_GE(second.components.size(), 50u);
    EXPECT_EQ(first.status, Status::kNodeLimit);
    EXPECT_EQ(all.components[0].cost, first.components[0].cost);
    EXPECT_EQ(all.components[0].lower_bound, first.components[0].lower_bound);
    EXPECT_EQ(all.stats.nodes, first.stats.nodes + second.stats.nodes);
    EXPECT_EQ(all.stats.recoveries, first.stats.recoveries + second.stats.recoveries);
    EXPECT_EQ(all.stats.dual_evaluations,
              first.stats.dual_evaluations + second.stats.dual_evaluations);
  }
}

// What is told of a solve on a machine that is so slow wherever anything is found.
std::vector<std::tuple<std::string, double, double>> course(const Problem& problem,
                                                            Options options,
                                                            std::chrono::milliseconds delay) {
  std::vector<std::tuple<std::string, double, double>> told;
  options.progress = [&](const Progress& progress) {
    std::this_thread::sleep_for(delay);
    if (progress.event != std::string("working"))
      told.emplace_back(progress.event, progress.cost, progress.lower_bound);
    return true;
  };
  const Solution solution = solve(problem, options);
  told.emplace_back("nodes", static_cast<double>(solution.stats.nodes), solution.lower_bound);
  return told;
}

// No budget is a share of the time that something else took.
TEST(Work, DoesNotFollowTheClock) {
  const Problem problem = sparse_problem(16, 1200, 1e3, 1);
  const Options options = limited(DualMethod::kBundleTrust);
  const auto quick = course(problem, options, std::chrono::milliseconds(0));
  EXPECT_GT(quick.size(), 8);
  EXPECT_EQ(course(problem, options, std::chrono::milliseconds(40)), quick);
}

// Two dimensions of 200 indices at random, the assignment of which takes most of an evaluation:
// there are fifty at most before a linear program takes over.
TEST(Work, AsksForFewAssignments) {
  PooreSparseOptions large;
  large.dimensions = 3;
  large.min_size = large.max_size = 200;
  large.arcs = 5000;
  Options options;
  options.branch.max_nodes = 0;
  options.search.local_search = false;
  const Solution solution = solve(generate_poore_sparse(large).problem, options);
  ASSERT_EQ(solution.components.size(), 1u);
  EXPECT_GT(solution.stats.dual_evaluations, 0);
  EXPECT_LE(solution.stats.dual_evaluations, 50);
}

// Whole numbers of hardly any size, so that bounds round up by much, and the same times pi.
TEST(Work, IsLessWhereCostsLieOnAGrid) {
  std::int64_t on_grid = 0, off_grid = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Map3Options cube;
    cube.size = 6;
    cube.max_cost = 2;
    cube.seed = seed;
    const Problem problem = generate_map3(cube).problem;
    const Problem scaled =
        rebuilt(problem, sizes_of(problem), [](Tuple&, double& cost) { cost *= std::numbers::pi; });
    Options options;
    options.branch.exact_arcs = 0;
    const Solution whole = solve(problem, options);
    const Solution real = solve(scaled, options);
    EXPECT_TRUE(whole.proven && real.proven);
    EXPECT_NEAR(real.cost, whole.cost * std::numbers::pi, 1e-9 * (1 + whole.cost));
    on_grid += whole.stats.dual_evaluations;
    off_grid += real.stats.dual_evaluations;
  }
  EXPECT_LT(on_grid, off_grid * 3 / 4);
}

}  // namespace
}  // namespace nda
