#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mip/external_solver.hpp"
#include "mip_support.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "support/many_to_one_problems.hpp"

// A thousand random problems with bounds, larger than enumeration can deal with, against CBC.  A
// start of CBC takes longer than such a problem, so those that have a solution go to it by the
// dozen, side by side in one problem: if the sums agree, so does every one, as none can be cheaper
// than its optimum.

namespace nda::mip {
namespace {

constexpr std::uint64_t kCases = 250;  // of each of four
constexpr std::size_t kSideBySide = 10;

Problem random_case(std::uint64_t seed) {
  support::BoundedKind kind;
  kind.dimensions = 2 + static_cast<int>(seed % 4);
  kind.largest = 9;
  kind.num_arcs = 20 + static_cast<int>(seed % 50);
  kind.integer = seed % 2 == 0;
  kind.forbidding = seed % 7 == 0;
  kind.tight = seed % 5 < 3;
  return support::random_bounded_problem(seed, kind);
}

std::vector<Index> sum_of_sizes(const std::vector<Problem>& problems) {
  std::vector<Index> sizes(5, 0);
  for (const Problem& problem : problems) {
    for (int k = 0; k < problem.num_dimensions(); ++k)
      sizes[static_cast<std::size_t>(k)] += problem.size(k);
  }
  return sizes;
}

// Indices one after the other, dimensions that a problem lacks are dummies.
Problem side_by_side(const std::vector<Problem>& problems) {
  ProblemBuilder builder(sum_of_sizes(problems));
  std::vector<Index> first(5, 0);
  for (const Problem& problem : problems) {
    const auto moved = [&](std::vector<Index> tuple) {
      for (std::size_t k = 0; k < tuple.size(); ++k) tuple[k] += tuple[k] != 0 ? first[k] : 0;
      tuple.resize(5, 0);
      return tuple;
    };
    for (std::size_t a = 0; a < problem.num_arcs(); ++a)
      builder.add_arc(moved(problem.arc(a)), problem.costs()[a]);
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        std::vector<Index> tuple(5, 0);
        tuple[static_cast<std::size_t>(k)] = i;
        builder.add_arc(moved(tuple), problem.singleton_costs(k)[i]);
        builder.set_use_bounds(k, i + first[static_cast<std::size_t>(k)], problem.use_bounds(k, i));
      }
    }
    for (int k = 0; k < problem.num_dimensions(); ++k)
      first[static_cast<std::size_t>(k)] += problem.size(k);
  }
  return std::move(builder).build();
}

class ManyToOne : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(ManyToOne, AgreesWithCbc) {
  Scratch scratch;
  std::unique_ptr<ExternalSolver> cbc;
  for (const ExternalKind& kind : external_kinds()) {
    if (std::string(kind.name) == "cbc") cbc = kind.find({real_path(), scratch.path()});
  }
  if (!cbc) GTEST_SKIP() << "cbc is not installed: coinor-cbc";
  const ExternalLimits limits{60, 60, {}};
  std::vector<Problem> group;
  double sum = 0;
  int infeasible = 0;
  const std::uint64_t end = (GetParam() + 1) * kCases;
  for (std::uint64_t seed = GetParam() * kCases; seed < end; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = random_case(seed);
    const Solution solution = solve(problem);
    EXPECT_TRUE(check(problem, solution).passed());
    if (solution.status == Status::kInfeasible) {
      ++infeasible;
      EXPECT_FALSE(solution.reason.empty());
      EXPECT_STREQ(to_string(cbc->solve(problem, limits).status), "infeasible");
    } else {
      ASSERT_STREQ(to_string(solution.status), "optimal");
      sum += solution.cost;
      group.push_back(std::move(problem));
    }
    if (group.size() < kSideBySide && seed + 1 < end) continue;
    const ExternalAnswer answer = cbc->solve(side_by_side(group), limits);
    ASSERT_STREQ(to_string(answer.status), "optimal") << answer.note;
    EXPECT_NEAR(answer.cost, sum, 1e-6 * std::max(1.0, std::abs(sum)));
    group.clear();
    sum = 0;
  }
  EXPECT_GT(infeasible, 2);
}

INSTANTIATE_TEST_SUITE_P(Quarter, ManyToOne, ::testing::Range(std::uint64_t{0}, std::uint64_t{4}));

}  // namespace
}  // namespace nda::mip
