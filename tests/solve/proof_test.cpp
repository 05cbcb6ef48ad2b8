#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "solve/proven_problems.hpp"
#include "support/random_problems.hpp"
#include "support/rebuilt.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

Options cutting_on_averages() {
  Options options = branching();
  options.branch.averaged_cuts_indices = 0;
  return options;
}

TEST(Proof, IsThereOnDemandOnly) {
  EXPECT_FALSE(solve(gapped_problem(1)).proof);
  EXPECT_TRUE(solve(gapped_problem(1), plain()).proof);
  EXPECT_FALSE(solve(support::infeasible_by_hall().problem, plain()).proof);
}

TEST(Proof, ShowsTheOptimumOfRandomProblems) {
  int num_branched = 0, num_proofs = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    SCOPED_TRACE(test.description);
    for (const Options& options : {plain(), branching(), cutting_on_averages()}) {
      const Solution solution = solve(test.problem, options);
      ASSERT_EQ(solution.proof.has_value(), solution.status != Status::kInfeasible);
      if (!solution.proof) continue;
      ++num_proofs;
      const CheckReport report = check(test.problem, solution, *solution.proof);
      ASSERT_TRUE(report.passed()) << report.faults.front();
      num_branched += solution.stats.bound_by_branching;
    }
  }
  EXPECT_GT(num_branched, 100);
  EXPECT_GT(num_proofs, 4000);
}

TEST(Proof, ShowsWhatFixingAndSearchesProve) {
  int num_fixed = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, branching());
    ASSERT_TRUE(solution.proven);
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_TRUE(report.bound_right);
    for (const ProofPart& part : solution.proof->parts) num_fixed += part.steps.size() > 1;
  }
  EXPECT_GT(num_fixed, 50);
}

// Two of the smallest problems that no search ends before there is a tree.
TEST(Proof, ShowsWhatCutsAndBranchingProve) {
  for (const Index size : {14u, 16u}) {
    SCOPED_TRACE(size);
    PooreSparseOptions sparse;
    sparse.min_size = sparse.max_size = size;
    sparse.arcs = size == 14 ? 400 : 300;
    sparse.seed = 2;
    const Problem problem = generate_poore_sparse(sparse).problem;
    const Solution solution = solve(problem, branching());
    ASSERT_TRUE(solution.proven);
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_TRUE(report.bound_right);
    std::size_t num_branchings = 0, num_cuts = 0;
    for (const ProofStep& step : solution.proof->parts.at(0).steps) {
      num_branchings += step.rule == ProofRule::kTogether || step.rule == ProofRule::kApart;
      num_cuts += step.point.cuts.size();
    }
    EXPECT_GT(num_branchings, 3);
    EXPECT_GT(num_cuts, 20);
  }
}

// No linear program may follow, so the rounds have the last word.
TEST(Proof, ShowsWhatCutsOnAveragesProve) {
  Options options = cutting_on_averages();
  options.branch.max_nodes = 0;
  int num_raised = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, options);
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_LE(report.proof_bound, solve(problem).cost + 1e-9);
    EXPECT_GE(report.proof_bound, solution.lower_bound - 1e-9 * std::abs(solution.lower_bound));
    num_raised += solution.stats.bound_by_branching;
  }
  EXPECT_GT(num_raised, 50);
}

// Branching ends at the gap, which multipliers found on the way may have passed.
TEST(Proof, ShowsWhatIsStatedWhereAGapIsAllowed) {
  Options options = plain();
  options.branch.exact_arcs = 0;
  options.relative_gap = 0.01;
  options.relaxation.relative_tolerance = 0.1;
  support::RandomProblemOptions shape;
  shape.sizes.assign(6, 7);
  shape.num_arcs = 400;
  shape.dummy_share = 0.6;
  shape.singletons = support::SingletonKind::kForbidden;
  shape.plant = true;
  shape.costs = support::CostKind::kInteger;
  int num_raised = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = support::random_problem(seed, shape);
    const Solution solution = solve(problem, options);
    const CheckReport report = check(problem, solution, *solution.proof);
    EXPECT_TRUE(report.passed()) << report.faults.front();
    num_raised += solution.stats.bound_by_branching;
  }
  EXPECT_GT(num_raised, 20);
}

bool has_cliques(const Proof& proof) {
  return std::ranges::any_of(proof.parts, [](const ProofPart& part) {
    return std::ranges::any_of(
        part.steps, [](const ProofStep& step) { return step.rule == ProofRule::kCliques; });
  });
}

TEST(Proof, ShowsWhatCliquesProve) {
  for (const std::size_t exact_arcs :
       {std::size_t{128}, std::size_t{0}}) {  // at once, or in leaves
    int num_proofs = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      SCOPED_TRACE(seed);
      const Problem problem = dense_problem(seed);
      Options options = plain();
      options.branch.exact_arcs = exact_arcs;
      const Solution solution = solve(problem, options);
      ASSERT_TRUE(solution.proven);
      const CheckReport report = check(problem, solution, *solution.proof);
      ASSERT_TRUE(report.passed()) << report.faults.front();
      EXPECT_TRUE(report.bound_right);
      num_proofs += has_cliques(*solution.proof);
    }
    EXPECT_GT(num_proofs, 3) << exact_arcs;
  }
}

// Three arcs that save 7, each pair in conflict: multipliers alone fall short by half of that.
TEST(Proof, HoldsWhereSingletonsCostMuchMoreThanArcsSave) {
  for (const double alone : {1e3, 1e5, 1e7, 1e9}) {
    SCOPED_TRACE(alone);
    const double pair = 2 * alone - 7;
    const Problem problem = support::make_problem({1, 1, 1},
                                                  {{{1, 0, 0}, alone},
                                                   {{0, 1, 0}, alone},
                                                   {{0, 0, 1}, alone},
                                                   {{1, 1, 0}, pair},
                                                   {{1, 0, 1}, pair},
                                                   {{0, 1, 1}, pair}});
    const Solution solution = solve(problem, plain());
    EXPECT_EQ(solution.cost, 3 * alone - 7);
    EXPECT_NEAR(check_proof(problem, *solution.proof).lower_bound, solution.cost, 1e-12 * alone);
  }
}

// Costs of 1e-280 and less: units of searches cannot be as small as they should.
TEST(Proof, HoldsForTinyCosts) {
  int num_branched = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    SCOPED_TRACE(test.description);
    const int exponent = -940 - static_cast<int>(seed % 50);
    const Problem problem = support::rebuilt(
        test.problem, support::sizes_of(test.problem), [&](support::Tuple&, double& cost) {
          cost = std::ldexp(cost, exponent);
        });
    for (const Options& options : {plain(), branching()}) {
      const Solution solution = solve(problem, options);
      if (!solution.proof) continue;
      const CheckReport report = check(problem, solution, *solution.proof);
      ASSERT_TRUE(report.passed()) << report.faults.front() << ", times 2^" << exponent;
      num_branched += solution.stats.bound_by_branching;
    }
  }
  EXPECT_GT(num_branched, 50);
}

TEST(Proof, ShowsWhatIsKnownWhenALimitStrikes) {
  int num_stopped = 0;
  Options options = branching();
  options.branch.max_nodes = 2;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, options);
    num_stopped += solution.status == Status::kNodeLimit;
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_GE(report.proof_bound,
              report.certificate_bound - 1e-9 * std::abs(report.certificate_bound));
  }
  EXPECT_GT(num_stopped, 10);
}

TEST(Proof, SurvivesItsFile) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, branching());
    std::ostringstream text;
    write_proof(*solution.proof, text);
    const Proof again = parse_proof(text.str());
    std::ostringstream twice;
    write_proof(again, twice);
    EXPECT_EQ(text.str(), twice.str());
    EXPECT_EQ(check_proof(problem, again).lower_bound,
              check_proof(problem, *solution.proof).lower_bound);
  }
}

// A byte changed, left out or put in: refused, or the same proof laid out otherwise.
TEST(Proof, IsRefusedWhenItsFileWasChanged) {
  core::Random random(2);
  int num_changed = 0;
  for (std::uint64_t seed = 0; num_changed < 1000; seed = (seed + 1) % 200) {
    std::ostringstream written;
    write_proof(*solve(gapped_problem(seed), branching()).proof, written);
    const std::string text = written.str();
    ASSERT_NO_THROW(parse_proof(text));
    for (int trial = 0; trial < 20; ++trial) {
      std::string changed = text;
      const std::size_t at = random.below(text.size());
      const char byte = "0123456789.-e \nabps"[random.below(19)];
      switch (random.below(4)) {
        case 0:
          changed[at] = byte;
          break;
        case 1:
          changed.erase(at, 1);
          break;
        case 2:
          changed.insert(at, 1, byte);
          break;
        default:
          changed.resize(at);
      }
      try {
        std::ostringstream again;
        write_proof(parse_proof(changed), again);
        ASSERT_EQ(again.str(), text) << changed;
      } catch (const InputError&) {
        ++num_changed;
      }
    }
  }
}

TEST(Proof, DoesNotDependOnTheNumberOfThreads) {
  Options options = branching();
  std::ostringstream one, two;
  write_proof(*solve(gapped_problem(4), options).proof, one);
  options.num_threads = 2;
  write_proof(*solve(gapped_problem(4), options).proof, two);
  EXPECT_EQ(one.str(), two.str());
}

}  // namespace
}  // namespace nda
