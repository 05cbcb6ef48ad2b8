#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "solve/branched_proofs.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"

namespace nda {
namespace {

int count(const Proof& proof, ProofRule rule) {
  int number = 0;
  for (const ProofPart& part : proof.parts) {
    number += static_cast<int>(std::count_if(
        part.steps.begin(), part.steps.end(), [&](const auto& step) { return step.rule == rule; }));
  }
  return number;
}

struct Seen {
  int proofs = 0, covers = 0, splits = 0, fixings = 0, on_grid = 0;

  void note(const Proof& proof) {
    ++proofs;
    covers += count(proof, ProofRule::kCover);
    splits += count(proof, ProofRule::kSplit);
    fixings += count(proof, ProofRule::kFix);
    on_grid += proof.grid > 0;
  }
};

// The optimum may be 0 where terms are not.
double scale_of(const Problem& problem, double optimum) {
  double largest = 0;
  for (const double cost : problem.costs()) largest = std::max(largest, std::abs(cost));
  return std::max(std::abs(optimum), 1e-6 * largest);
}

void expect_proof(const Problem& problem, const BranchedProof& proven, double optimum) {
  const ProofReport report = check_proof(problem, proven.proof);
  EXPECT_EQ(report.fault, "");
  const double scale = std::max(scale_of(problem, optimum), std::abs(proven.lower));
  EXPECT_LE(report.lower_bound, optimum + 1e-12 * scale);
  EXPECT_GE(report.lower_bound, proven.lower - 1e-9 * scale);
  if (proven.complete) {
    EXPECT_NEAR(report.lower_bound, optimum, 1e-9 * scale);
  }
}

// Every kind of cost, on grids and off them, and of singleton, forbidden ones among them.  Costs so
// unlike that their sums lose digits (`kWild`) have no exact answer to compare with.
TEST(BranchedProof, ShowsTheOptimumOfRandomProblems) {
  Seen seen;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    if (test.options.costs == support::CostKind::kWild) continue;
    SCOPED_TRACE(test.description);
    const auto optimum = support::brute_force(test.problem);
    if (!optimum) continue;
    const std::size_t enumerated = 3 * (seed % 4);
    const BranchedProof proven = prove_by_branching(test.problem, enumerated);
    expect_proof(test.problem, proven, optimum->cost);
    EXPECT_EQ(prove_by_branching(test.problem, enumerated, false).nodes, proven.nodes);
    seen.note(proven.proof);
    if (HasFailure()) return;
  }
  EXPECT_GT(seen.proofs, 3000);
  EXPECT_GT(seen.covers, 1000);
  EXPECT_GT(seen.splits, 500);
  EXPECT_GT(seen.on_grid, 1000);
}

TEST(BranchedProof, ShowsWhatIsKnownWhenALimitStrikes) {
  int num_stopped = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    if (test.options.costs == support::CostKind::kWild) continue;
    SCOPED_TRACE(test.description);
    const auto optimum = support::brute_force(test.problem);
    if (!optimum) continue;
    const BranchedProof proven =
        prove_by_branching(test.problem, 3, true, static_cast<std::int64_t>(seed % 6));
    expect_proof(test.problem, proven, optimum->cost);
    num_stopped += !proven.complete;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_stopped, 100);
}

Problem small_problem(int family, std::uint64_t seed) {
  const auto small = static_cast<Index>(3 + seed % 3);
  if (family == 0) {
    PooreSparseOptions options;
    options.dimensions = 3 + static_cast<int>(seed % 3);
    options.min_size = 4;
    options.max_size = small + 3;
    options.arcs = 40 + seed % 4 * 10;
    options.seed = seed;
    return generate_poore_sparse(options).problem;
  }
  if (family == 1) {
    Map3Options options;
    options.size = small;
    options.max_cost = seed % 2 == 0 ? 5 : 100;
    options.seed = seed;
    return generate_map3(options).problem;
  }
  if (family == 2) {
    TrackingOptions options = tracking_preset(seed % 2 == 0 ? "hard6" : "small");
    options.side = 400;
    options.scans = 3 + static_cast<int>(seed % 3);
    options.targets = 4 + static_cast<int>(seed % 5);
    options.clutter = 3;
    options.cap = 20;
    options.seed = seed;
    return generate_tracking(options).problem;
  }
  if (family == 3) {
    PlantedOptions options;
    options.size = 6 + small;
    options.arcs = 10 * options.size;
    options.spread = 4;
    options.singletons = static_cast<PlantedSingletons>(seed % 3);
    if (options.singletons == PlantedSingletons::kForbidden) options.miss_rate = 0;
    options.seed = seed;
    return generate_planted(options).problem;
  }
  if (family == 4) {
    PooreDenseOptions options;
    options.dimensions = 3;
    options.min_size = 2;
    options.max_size = small;
    options.seed = seed;
    return generate_poore_dense(options).problem;
  }
  if (family == 5) {
    GadgetsOptions options;
    options.gadgets = 1 + static_cast<int>(seed % 4);
    options.size = 3;
    options.arcs_per_gadget = 14;
    options.seed = seed;
    return generate_gadgets(options).problem;
  }
  MergedOptions options;
  options.scans = 2 + static_cast<int>(seed % 2);
  options.targets = static_cast<int>(small);
  options.side = 100;
  options.seed = seed;
  return generate_merged(options).problem;
}
constexpr int kNumFamilies = 7;

TEST(BranchedProof, ShowsTheOptimumOfEveryFamily) {
  Seen seen;
  for (int family = 0; family < kNumFamilies; ++family) {
    SCOPED_TRACE(family);
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(seed);
      const Problem problem = small_problem(family, seed);
      if (problem.is_many_to_one()) continue;
      const Solution solution = solve(problem);
      if (solution.status != Status::kOptimal) continue;
      const BranchedProof proven = prove_by_branching(problem, 12);
      ASSERT_TRUE(proven.complete);
      expect_proof(problem, proven, solution.cost);
      seen.note(proven.proof);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(seen.proofs, 60);
  EXPECT_GT(seen.covers, 300);
  EXPECT_GT(seen.splits, 100);
}

}  // namespace
}  // namespace nda
