#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"

namespace nda {
namespace {

using support::brute_force;
using support::random_case;
using support::RandomCase;

// Size of the terms of any solution: what rounding is relative to.
double magnitude(const Problem& problem) {
  double largest = 0;
  for (const double cost : problem.costs()) largest = std::max(largest, std::abs(cost));
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (cost < kInfinity) largest = std::max(largest, std::abs(cost));
    }
  }
  return largest * static_cast<double>(problem.num_indices());
}

// Every way to solve: the exact ones must find the optimum, all must give valid bounds.
struct Path {
  const char* name;
  Options options;
  bool exact;
};

// Every number of kept sets, relaxed problems solved exactly and not, and every order of sets.
void add_relaxations(const Options& relaxation, std::vector<Path>& result) {
  for (const int kept_sets : {0, 1, 3, 64}) {
    Options options = relaxation;
    options.relaxation.kept_sets = kept_sets;
    options.relaxation.max_evaluations = 6;
    result.push_back({"other kept sets", options, false});
    if (kept_sets < 3) continue;
    options.relaxation.kept_exact_arcs = 0;
    options.relaxation.kept_evaluations = 2;
    options.relaxation.two_first = false;
    result.push_back({"merit function", options, false});
    options.relaxation.merit = options.relaxation.decompose = false;
    result.push_back({"no merit function", options, false});
  }
  int kept_sets = 1;
  for (const SetOrder order :
       {SetOrder::kLargestFirst, SetOrder::kMostConflictingFirst, SetOrder::kProbe}) {
    Options options = relaxation;
    options.relaxation.kept_sets = kept_sets++;
    options.relaxation.max_evaluations = 6;
    options.relaxation.set_order = options.relaxation.recovery_order = order;
    result.push_back({"order of sets", options, false});
  }
}

std::vector<Path> paths() {
  std::vector<Path> result;
  result.push_back({"default", {}, true});
  Options enumerate_all;
  enumerate_all.method = Method::kExact;
  result.push_back({"enumeration", enumerate_all, true});
  Options branch;
  branch.branch.exact_arcs = 0;
  branch.relaxation.max_evaluations = 5;
  branch.branch.node_evaluations = 3;
  branch.search.local_search = false;
  result.push_back({"branch and bound", branch, true});
  branch.branch.averaged_cuts_indices = 0;
  result.push_back({"cuts on averages", branch, true});
  Options relaxation;
  relaxation.method = Method::kRelaxation;
  relaxation.branch.exact_arcs = 0;
  result.push_back({"relaxation", relaxation, false});
  for (const DualMethod method :
       {DualMethod::kSubgradient, DualMethod::kVolume, DualMethod::kCoordinate}) {
    Options options = relaxation;
    options.relaxation.dual_method = method;
    result.push_back({"other dual method", options, false});
  }
  for (const Assign2dMethod method : {Assign2dMethod::kAuction, Assign2dMethod::kNetworkSimplex}) {
    Options options = relaxation;
    options.relaxation.max_evaluations = 20;
    options.relaxation.assign2d = method;
    result.push_back({"other assignment", options, false});
  }
  add_relaxations(relaxation, result);
  return result;
}

void expect_agrees(const Problem& problem,
                   const Path& path,
                   const std::optional<support::ExactSolution>& truth) {
  const Solution solution = solve(problem, path.options);
  const double tolerance =
      1e-14 * magnitude(problem) + (truth ? 1e-9 * std::abs(truth->cost) : 0.0);
  if (!truth) {
    EXPECT_TRUE(solution.solutions.empty());
    if (path.exact) {
      EXPECT_EQ(solution.status, Status::kInfeasible);
    }
    if (solution.status == Status::kInfeasible) {
      EXPECT_FALSE(solution.reason.empty());
    }
    return;
  }
  EXPECT_NE(solution.status, Status::kInfeasible);
  EXPECT_LE(solution.lower_bound, truth->cost + tolerance);
  EXPECT_LE(solution.stats.certificate_bound, truth->cost + tolerance);
  const CheckReport report = check(problem, solution);
  EXPECT_TRUE(report.passed()) << (report.faults.empty() ? "" : report.faults.front());
  if (path.exact || solution.proven) {
    ASSERT_FALSE(solution.solutions.empty());
    EXPECT_NEAR(solution.cost, truth->cost, tolerance);
  }
  if (path.exact) {
    EXPECT_TRUE(solution.status == Status::kOptimal || solution.status == Status::kPrecisionLost)
        << to_string(solution.status);
  }
  for (const RankedSolution& ranked : solution.solutions) {
    EXPECT_THAT(ranked.arcs, support::IsFeasibleFor(problem));
    EXPECT_GE(ranked.cost, truth->cost - tolerance);
  }
}

// Each shard takes a share of the ten thousand instances, so that they run in parallel.
class Exactness : public ::testing::TestWithParam<int> {};

constexpr int kShards = 8;
constexpr std::uint64_t kInstances = 10000;

TEST_P(Exactness, EveryPathAgreesWithBruteForce) {
  const std::vector<Path> all_paths = paths();
  for (std::uint64_t seed = static_cast<std::uint64_t>(GetParam()); seed < kInstances;
       seed += kShards) {
    const RandomCase random = random_case(seed);
    SCOPED_TRACE(random.description);
    const auto truth = brute_force(random.problem);
    for (const Path& path : all_paths) {
      SCOPED_TRACE(path.name);
      expect_agrees(random.problem, path, truth);
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shards, Exactness, ::testing::Range(0, kShards));

}  // namespace
}  // namespace nda
