#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/random.hpp"
#include "nda/proof.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::HasSubstr;

// Of support::odd_cycle(): three arcs of -1, pairwise in conflict, optimum -1, LP -1.5.
Proof frame(std::vector<ProofStep> steps) {
  Proof proof;
  proof.sizes = {1, 1, 1};
  proof.num_arcs = 3;
  proof.parts.push_back({{{0, 1}, {1, 1}, {2, 1}}, std::move(steps)});
  return proof;
}

ProofStep bound(double u, std::vector<ProofCut> cuts = {}) {
  return {ProofRule::kBound, {{{0, u}, {1, u}, {2, u}}, std::move(cuts)}, 0, 0, 0};
}

ProofStep search(double u, double threshold) {
  return {ProofRule::kSearch, {{{0, u}, {1, u}, {2, u}}, {}}, threshold, 0, 0};
}

ProofStep cliques(double u, double threshold) {
  return {ProofRule::kCliques, {{{0, u}, {1, u}, {2, u}}, {}}, threshold, 0, 0};
}

ProofReport report(const Proof& proof) {
  return check_proof(support::odd_cycle().problem, proof);
}

void expect_bound(const Proof& proof, double bound) {
  const ProofReport verdict = report(proof);
  EXPECT_TRUE(verdict.passed()) << verdict.fault;
  EXPECT_LE(verdict.lower_bound, bound);
  EXPECT_NEAR(verdict.lower_bound, bound, 1e-12);
}

TEST(CheckProof, ComputesTheBoundOfMultipliers) {
  expect_bound(frame({bound(-0.5)}), -1.5);
  expect_bound(frame({bound(-2)}), -6);
  expect_bound(frame({bound(1)}), 3 - 3 * 3 - 3 * 1);  // arcs -1 - 2, singletons 0 - 1
}

TEST(CheckProof, CountsCuts) {
  expect_bound(frame({bound(0, {{{0, 1, 2}, {1, 1, 1}, 2, -1}})}), -1);
  expect_bound(frame({bound(0, {{{0, 1, 2}, {1, 1, 1}, 2, -3}})}), -3);
  // floor(2 / 1) = 2 for every arc, floor(3 / 1) = 3 on the right.
  expect_bound(frame({bound(0, {{{0, 1, 2}, {1, 1, 1}, 1, -0.5}})}), -1.5);
}

TEST(CheckProof, SearchesBelowAThreshold) {
  expect_bound(frame({search(-0.5, -1)}), -1);
  expect_bound(frame({search(-0.5, -1.25)}), -1.25);
  expect_bound(frame({search(-0.5, 0)}), -1);
}

TEST(CheckProof, CoversByCliques) {
  expect_bound(frame({cliques(0, -1)}), -1);
  expect_bound(frame({cliques(0, -1.25)}), -1.25);
  expect_bound(frame({cliques(0, 0)}), -1);
  expect_bound(frame({cliques(-0.5, 0)}), -1.5);    // no arc gains anything over these
  expect_bound(frame({cliques(1, 0)}), 3 - 3 - 3);  // arcs gain 3, singletons 1 each
}

// One arc uses both of the first two indices, or none does; where one must, covering them is worth
// more than any arc costs.
TEST(CheckProof, CoversByCliquesBelowBranchings) {
  const ProofStep apart{ProofRule::kApart, {}, 0, 0, 1};
  const ProofStep demand{ProofRule::kCliques, {{{0, 4}, {1, 0}, {2, 0}}, {}}, 0, 0, 0};
  expect_bound(frame({apart, cliques(0, 0), demand}), -1);
}

TEST(CheckProof, TakesTheWorseChild) {
  const ProofStep together{ProofRule::kTogether, {}, 0, 0, 1};
  const ProofStep apart{ProofRule::kApart, {}, 0, 0, 1};
  // One arc uses both: -1.  None does: (1, 0, 1) or (0, 1, 1), u = 0 0 -1.
  const ProofStep none{ProofRule::kBound, {{{0, 0}, {1, 0}, {2, -1}}, {}}, 0, 0, 0};
  expect_bound(frame({together, bound(-0.5), none}), -1.5);  // index 3 alone is charged -0.5
  expect_bound(frame({together, search(0, 0), none}), -1);
  expect_bound(frame({apart, none, search(0, 0)}), -1);
}

TEST(CheckProof, ForbidsArcsByTheirReducedCost) {
  // Bound -2.5 with reduced costs 1, 1, 0 of arcs 2 3, 1 3, 1 2: the first two are out.
  const ProofStep fix{ProofRule::kFix, {{{0, -0.5}, {1, -0.5}, {2, -1.5}}, {}}, -1.6, 0, 0};
  const ProofStep rest{ProofRule::kBound, {{{0, -1}, {1, 0}, {2, 0}}, {}}, 0, 0, 0};
  expect_bound(frame({fix, rest}), -1.6);
  ProofStep higher = fix;
  higher.threshold = -1.4;
  expect_bound(frame({higher, rest}), -2);  // nothing is out: arc 2 3 has reduced cost -1
}

TEST(CheckProof, RoundsUpOnAGrid) {
  Proof proof = frame({bound(-0.5)});
  proof.grid = 1;
  expect_bound(proof, -1);
  proof.grid = 0.25;
  expect_bound(proof, -1.5);
}

TEST(CheckProof, ChargesIndicesOfNoPartTheirSingletons) {
  const Problem problem = support::make_problem(
      {2, 1}, {{{1, 1}, -2}, {{2, 1}, 5}, {{2, 0}, 3}, {{0, 1}, 1}, {{1, 0}, 0}});
  Proof proof;
  proof.sizes = {2, 1};
  proof.num_arcs = 2;
  proof.parts.push_back({{{0, 1}, {1, 1}}, {{ProofRule::kBound, {{{0, -2}}, {}}, 0, 0, 0}}});
  // (2, 1) costs no less than its singletons 3 + 1: not worth using.
  const ProofReport verdict = check_proof(problem, proof);
  EXPECT_TRUE(verdict.passed()) << verdict.fault;
  EXPECT_NEAR(verdict.lower_bound, 3 - 2, 1e-12);
}

struct Spoiled {
  const char* fault;
  std::function<void(Proof&)> spoil;
};

TEST(CheckProof, NamesTheFault) {
  const auto point = [](Proof& proof) -> ProofPoint& { return proof.parts[0].steps[0].point; };
  const std::vector<Spoiled> all = {
      {"other sizes",
       [](Proof& p) {
         p.sizes = {1, 1, 2};
       }},
      {"with 4 arcs", [](Proof& p) { p.num_arcs = 4; }},
      {"the grid is not positive", [](Proof& p) { p.grid = -1; }},
      {"not a multiple of the grid", [](Proof& p) { p.grid = 0.3; }},
      {"index is in two places", [](Proof& p) { p.parts.push_back(p.parts[0]); }},
      {"index is out of range", [](Proof& p) { p.parts[0].indices[0].dimension = 3; }},
      {"index is out of range", [](Proof& p) { p.parts[0].indices[0].index = 0; }},
      {"lies in no part", [](Proof& p) { p.parts.clear(); }},
      {"the tree has no end", [](Proof& p) { p.parts[0].steps.clear(); }},
      {"steps are left over", [](Proof& p) { p.parts[0].steps.push_back(bound(0)); }},
      {"multiplier is of an index out of range",
       [&](Proof& p) {
         point(p).changes.push_back({3, 1});
       }},
      {"multiplier is not finite", [&](Proof& p) { point(p).changes[0].value = kInfinity; }},
      {"not one weight an index", [&](Proof& p) { point(p).cuts[0].weights.pop_back(); }},
      {"divisor 0", [&](Proof& p) { point(p).cuts[0].divisor = 0; }},
      {"not finite and <= 0", [&](Proof& p) { point(p).cuts[0].multiplier = 1; }},
      {"same index twice", [&](Proof& p) { point(p).cuts[0].positions[0] = 1; }},
      {"over an index out of range", [&](Proof& p) { point(p).cuts[0].positions[2] = 3; }},
      {"no pair",
       [](Proof& p) {
         p.parts[0].steps.insert(p.parts[0].steps.begin(), {ProofRule::kApart, {}, 0, 1, 1});
       }},
      {"too wide",
       [&](Proof& p) {
         p.parts[0].steps[0].rule = ProofRule::kSearch;
         point(p).cuts[0].weights = {255, 255, 255};
         point(p).cuts[0].divisor = 1;
       }},
      {"without a finite threshold", [](Proof& p) { p.parts[0].steps = {search(0, kInfinity)}; }},
      {"without a finite threshold", [](Proof& p) { p.parts[0].steps = {cliques(0, kInfinity)}; }},
      {"gains of the search are too large",
       [](Proof& p) { p.parts[0].steps = {cliques(1.7e308, 0)}; }},
  };
  for (const Spoiled& spoiled : all) {
    Proof proof = frame({bound(0, {{{0, 1, 2}, {1, 1, 1}, 2, -1}})});
    spoiled.spoil(proof);
    const ProofReport verdict = report(proof);
    EXPECT_THAT(verdict.fault, HasSubstr(spoiled.fault));
    EXPECT_EQ(verdict.lower_bound, -kInfinity);
  }
}

TEST(CheckProof, RefusesTreesTooDeepForTheStack) {
  std::vector<ProofStep> steps(200000, {ProofRule::kApart, {}, 0, 0, 1});
  EXPECT_THAT(report(frame(std::move(steps))).fault, HasSubstr("too deep"));
}

// A ladder: arcs (i, i) and (i, i + 1), and a proof that searches it rung by rung.
ProofReport search_ladder(Index length) {
  ProblemBuilder builder({length, length});
  Proof proof;
  proof.sizes = {length, length};
  proof.num_arcs = 2 * std::size_t{length} - 1;
  proof.parts.push_back({{}, {{ProofRule::kSearch, {}, 0, 0, 0}}});
  for (Index i = 1; i <= length; ++i) {
    builder.add_arc({i, i}, -1);
    if (i < length) builder.add_arc({i, i + 1}, -1);
    for (const int k : {0, 1}) {
      const auto position = static_cast<std::uint32_t>(proof.parts[0].indices.size());
      proof.parts[0].indices.push_back({k, i});
      proof.parts[0].steps[0].point.changes.push_back({position, -0.5});
    }
  }
  return check_proof(std::move(builder).build(), proof);
}

TEST(CheckProof, SearchesNoDeeperThanTheStackAllows) {
  const ProofReport deepest = search_ladder(kMostProofSearchDepth - 10);
  EXPECT_EQ(deepest.fault, "");
  EXPECT_NEAR(deepest.lower_bound, -(kMostProofSearchDepth - 10), 1e-9);
  EXPECT_THAT(search_ladder(kMostProofSearchDepth + 10).fault, HasSubstr("too deep"));
}

TEST(CheckProof, SearchesNothingWithBudgetsBeyondReckoning) {
  for (const double u : {1e308, -1e308, 1.7e308}) {
    const ProofReport verdict = report(frame({search(u, 1000)}));
    EXPECT_LE(verdict.lower_bound, -1) << u;
  }
  EXPECT_LE(report(frame({search(-1e308, 1.7e308)})).lower_bound, -1);
}

TEST(CheckProof, SearchesWithinCuts) {
  // The triangle's clique: u = 0, multiplier -1, no slack anywhere: the first arc is the answer.
  const ProofCut clique = {{0, 1, 2}, {1, 1, 1}, 2, -1};
  const ProofPoint point = {{{0, 0}, {1, 0}, {2, 0}}, {clique}};
  expect_bound(frame({{ProofRule::kSearch, point, 0, 0, 0}}), -1);
  expect_bound(frame({{ProofRule::kSearch, point, -1, 0, 0}}), -1);
}

// Any tree at all, with any numbers.
class RandomProof {
 public:
  RandomProof(const Problem& problem, core::Random& random) : random_(random) {
    proof_.sizes.assign(problem.sizes().begin(), problem.sizes().end());
    proof_.num_arcs = problem.num_arcs();
    ProofPart part;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) part.indices.push_back({k, i});
    }
    num_ = part.indices.size();
    for (const double cost : problem.costs()) scale_ = std::max(scale_, std::abs(cost));
    grow(part.steps, 0);
    proof_.parts.push_back(std::move(part));
  }

  const Proof& proof() const { return proof_; }

 private:
  double number() { return random_.uniform(-1, random_.below(3) == 0 ? 1 : 0) * scale_; }
  std::uint32_t position() { return static_cast<std::uint32_t>(random_.below(num_)); }

  ProofPoint point(bool with_cuts) {
    ProofPoint point;
    for (std::size_t n = random_.below(2 * num_); n > 0; --n)
      point.changes.push_back({position(), number()});
    for (std::size_t n = with_cuts ? random_.below(4) : 0; n > 0; --n) {
      ProofCut cut;
      for (std::uint32_t p = 0; p < num_; ++p) {
        if (random_.below(2) == 0) continue;
        cut.positions.push_back(p);
        cut.weights.push_back(static_cast<std::uint8_t>(random_.below(4)));
      }
      cut.divisor = static_cast<std::uint8_t>(1 + random_.below(4));
      cut.multiplier = -std::abs(number());
      point.cuts.push_back(cut);
    }
    return point;
  }

  void grow(std::vector<ProofStep>& steps, int depth) {
    for (std::size_t n = random_.below(3); n > 0; --n)
      steps.push_back({ProofRule::kFix, point(true), 3 * number(), 0, 0});
    if (depth < 4 && num_ > 1 && random_.below(2) == 0) {
      const std::uint32_t first = position();
      const auto second = static_cast<std::uint32_t>((first + 1 + position() % (num_ - 1)) % num_);
      const ProofRule rule = random_.below(2) == 0 ? ProofRule::kTogether : ProofRule::kApart;
      steps.push_back({rule, {}, 0, first, second});
      grow(steps, depth + 1);
      grow(steps, depth + 1);
    } else if (const std::uint64_t kind = random_.below(3); kind > 0) {
      const ProofRule rule = kind == 1 ? ProofRule::kSearch : ProofRule::kCliques;
      steps.push_back({rule, point(true), 3 * number(), 0, 0});
    } else {
      steps.push_back({ProofRule::kBound, point(true), 0, 0, 0});
    }
  }

  core::Random& random_;
  Proof proof_;
  std::size_t num_ = 0;
  double scale_ = 1;
};

TEST(CheckProof, NeverShowsMoreThanTheOptimum) {
  int num_tight = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    const support::RandomCase test = support::random_case(seed);
    SCOPED_TRACE(test.description);
    const auto optimum = support::brute_force(test.problem);
    if (!optimum) continue;
    core::Random random(seed);
    for (int trial = 0; trial < 5; ++trial) {
      const RandomProof random_proof(test.problem, random);
      const ProofReport verdict = check_proof(test.problem, random_proof.proof());
      EXPECT_TRUE(verdict.passed()) << verdict.fault;
      ASSERT_LE(verdict.lower_bound, optimum->cost + 1e-13 * std::abs(optimum->cost));
      num_tight += verdict.lower_bound > optimum->cost - 1e-9 * std::abs(optimum->cost);
    }
  }
  EXPECT_GT(num_tight, 200);
}

}  // namespace
}  // namespace nda
