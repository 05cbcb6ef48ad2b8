#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/io.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

// Cuts and branching from the first arc on, the root's bound being poor.
Options branching() {
  Options options;
  options.proof = true;
  options.branch.exact_arcs = 0;
  options.relaxation.max_evaluations = 5;
  options.search.local_search = false;
  return options;
}

Options plain() {
  Options options;
  options.proof = true;
  return options;
}

// Gaps and components; small enough to be solved in milliseconds.
Problem gapped_problem(std::uint64_t seed) {
  support::RandomProblemOptions shape;
  shape.sizes.assign(3 + seed % 4, 8);
  shape.num_arcs = 60 + static_cast<int>(seed % 7) * 20;
  shape.costs = seed % 3 == 0 ? support::CostKind::kInteger : support::CostKind::kDecimal;
  shape.singletons =
      seed % 2 == 0 ? support::SingletonKind::kPriced : support::SingletonKind::kFree;
  return support::random_problem(seed, shape);
}

TEST(Proof, IsThereOnDemandOnly) {
  EXPECT_FALSE(solve(gapped_problem(1)).proof);
  EXPECT_TRUE(solve(gapped_problem(1), plain()).proof);
  EXPECT_FALSE(solve(support::infeasible_by_hall().problem, plain()).proof);
}

TEST(Proof, ShowsTheOptimumOfRandomProblems) {
  int num_branched = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    SCOPED_TRACE(test.description);
    for (const Options& options : {plain(), branching()}) {
      const Solution solution = solve(test.problem, options);
      if (solution.status == Status::kInfeasible) continue;
      if (!solution.proof) continue;
      const CheckReport report = check(test.problem, solution, *solution.proof);
      ASSERT_TRUE(report.passed()) << report.faults.front();
      num_branched += solution.stats.bound_by_branching;
    }
  }
  EXPECT_GT(num_branched, 100);
}

TEST(Proof, ShowsWhatCutsAndBranchingProve) {
  int num_trees = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, branching());
    ASSERT_TRUE(solution.proven);
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_TRUE(report.bound_right);
    for (const ProofPart& part : solution.proof->parts) num_trees += part.steps.size() > 1;
  }
  EXPECT_GT(num_trees, 50);
}

// Many indices an arc, few arcs: linear programs are far off, cliques are not.
Problem dense_problem(std::uint64_t seed) {
  support::RandomProblemOptions shape;
  shape.sizes.assign(20, 20);
  shape.num_arcs = 200;
  shape.dummy_share = 0.7;
  shape.costs = seed % 2 == 0 ? support::CostKind::kInteger : support::CostKind::kDecimal;
  shape.singletons = support::SingletonKind::kFree;
  return support::random_problem(seed, shape);
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

TEST(Proof, ShowsWhatIsKnownWhenALimitStrikes) {
  Options options = branching();
  options.branch.max_nodes = 2;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, options);
    const CheckReport report = check(problem, solution, *solution.proof);
    ASSERT_TRUE(report.passed()) << report.faults.front();
    EXPECT_GE(report.proof_bound,
              report.certificate_bound - 1e-9 * std::abs(report.certificate_bound));
  }
}

// Changes a proof in one place; returns false where nothing was there to be changed.
bool mutate(Proof& proof, core::Random& random) {
  ProofPart& part = proof.parts[random.below(proof.parts.size())];
  const std::size_t at = random.below(part.steps.size());
  ProofStep& step = part.steps[at];
  switch (random.below(7)) {
    case 0:
      part.steps.erase(part.steps.begin() + static_cast<std::ptrdiff_t>(at));
      return true;
    case 1:
      step.threshold += step.rule == ProofRule::kFix ? random.uniform(0.01, 10) : 0;
      return step.rule == ProofRule::kFix;
    case 2:
      step.threshold -= step.rule == ProofRule::kFix ? random.uniform(0.01, 10) : 0;
      return step.rule == ProofRule::kFix;
    case 3:
      if (step.point.changes.empty()) return false;
      step.point.changes[random.below(step.point.changes.size())].value += random.uniform(-9, 9);
      return true;
    case 4:
      if (step.point.cuts.empty()) return false;
      step.point.cuts.pop_back();
      return true;
    case 5:
      if (step.point.cuts.empty()) return false;
      ++step.point.cuts[random.below(step.point.cuts.size())].weights[0];
      return true;
    default:
      std::swap(step.first, step.second);
      step.rule = step.rule == ProofRule::kTogether ? ProofRule::kApart : ProofRule::kTogether;
      return step.point.changes.empty() && step.point.cuts.empty();
  }
}

// A changed proof fails, or falls short, or is a proof all the same: never does it show too much.
TEST(Proof, ShowsNothingWrongWhenChanged) {
  core::Random random(1);
  int num_mutants = 0, num_refused = 0;
  for (std::uint64_t seed = 0; num_mutants < 1000; seed = (seed + 1) % 200) {
    const Problem problem = gapped_problem(seed);
    const Solution solution = solve(problem, branching());
    for (int trial = 0; trial < 20 && !solution.proof->parts.empty(); ++trial) {
      Proof changed = *solution.proof;
      if (!mutate(changed, random)) continue;
      ++num_mutants;
      const ProofReport report = check_proof(problem, changed);
      num_refused += !check(problem, solution, changed).passed();
      ASSERT_LE(report.lower_bound, solution.cost + 1e-12 * std::abs(solution.cost));
    }
  }
  EXPECT_GT(num_refused, 400);
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

// Not by an accident of the text: the numbers of one proof under the digest of another.
TEST(Proof, IsRefusedUnderTheDigestOfAnother) {
  core::Random random(3);
  int num_mutants = 0;
  for (std::uint64_t seed = 0; num_mutants < 1000; seed = (seed + 1) % 200) {
    const Solution solution = solve(gapped_problem(seed), branching());
    std::ostringstream right;
    write_proof(*solution.proof, right);
    ASSERT_NO_THROW(parse_proof(right.str()));
    const std::string digest = right.str().substr(right.str().rfind("end"));
    for (int trial = 0; trial < 20 && !solution.proof->parts.empty(); ++trial) {
      Proof changed = *solution.proof;
      if (!mutate(changed, random)) continue;
      std::ostringstream wrong;
      write_proof(changed, wrong);
      const std::string text = wrong.str();
      ++num_mutants;
      ASSERT_THROW(parse_proof(text.substr(0, text.rfind("end")) + digest), InputError) << text;
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
