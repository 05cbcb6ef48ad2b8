#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/double_double.hpp"
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

ProofStep cover(std::uint32_t position, std::vector<std::uint32_t> uses) {
  ProofStep step{ProofRule::kCover, {}, 0, position, 0};
  step.uses = std::move(uses);
  return step;
}

ProofStep split(std::vector<std::vector<std::uint32_t>> groups) {
  ProofStep step{ProofRule::kSplit, {}, 0, 0, 0};
  step.groups = std::move(groups);
  return step;
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

// Arcs 2 and 3 use the first index.  With either of them nothing is left to gain, without the index
// arc 1 is; where nothing may use the index it can be worth anything.
TEST(CheckProof, BranchesOnTheUsesOfAnIndex) {
  const ProofStep demand{ProofRule::kBound, {{{0, 100}, {1, 0}, {2, 0}}, {}}, 0, 0, 0};
  expect_bound(frame({cover(0, {2, 3, 0}), bound(0), bound(0), bound(-0.5), demand}), -1);
  // Arcs 1 and 2 are left to the last child.
  expect_bound(frame({cover(0, {3, 0}), bound(0), bound(-0.5), bound(-0.5)}), -1.5);
  expect_bound(frame({cover(0, {}), bound(-0.5)}), -1.5);
  // Fixing has forbidden arc 2: what its child shows does not matter.
  const ProofStep fix{ProofRule::kFix, {{{0, -1}, {1, -1}, {2, -1}}, {}}, -2.1, 0, 0};
  expect_bound(frame({fix, cover(0, {2}), bound(-100), bound(0)}), -2.1);
}

TEST(CheckProof, AddsUpWhatGroupsCost) {
  const ProofStep demand{ProofRule::kBound, {{{0, 100}, {1, 0}, {2, 0}}, {}}, 0, 0, 0};
  const auto grouped = [&](std::vector<std::vector<std::uint32_t>> groups, double u, double rest) {
    return frame({cover(0, {2, 3, 0}),
                  bound(0),
                  bound(0),
                  split(std::move(groups)),
                  bound(u),
                  bound(rest),
                  demand});
  };
  expect_bound(grouped({{1, 2}}, -0.5, 0), -1);
  expect_bound(grouped({{1, 2}}, -0.6, 0), -1.2);
  Proof on_grid = grouped({{1, 2}}, -0.6, 0);
  on_grid.grid = 1;
  expect_bound(on_grid, -1);
  EXPECT_THAT(report(grouped({{1}}, 0, 0)).fault, HasSubstr("arc 1 connects two groups"));
  EXPECT_THAT(report(grouped({{0, 1, 2}}, 0, 0)).fault, HasSubstr("index that is not left"));
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
      {"arc 1 does not use the index",
       [](Proof& p) {
         p.parts[0].steps = {cover(0, {1}), bound(0), bound(0)};
       }},
      {"arc 4 does not use the index",
       [](Proof& p) {
         p.parts[0].steps = {cover(0, {4}), bound(0), bound(0)};
       }},
      {"index that is not left",
       [](Proof& p) {
         p.parts[0].steps = {cover(3, {0}), bound(0), bound(0)};
       }},
      {"index that is not left",
       [](Proof& p) {
         p.parts[0].steps = {cover(0, {0}), cover(0, {0}), bound(0), bound(0), bound(0)};
       }},
      {"in another group",
       [](Proof& p) {
         p.parts[0].steps = {split({{0, 1, 2, 0}}), bound(0), bound(0)};
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
  for (const ProofStep& step :
       {ProofStep{ProofRule::kApart, {}, 0, 0, 1}, cover(0, {}), split({{0, 1, 2}})}) {
    std::vector<ProofStep> steps(200000, step);
    EXPECT_THAT(report(frame(std::move(steps))).fault, HasSubstr("too deep"));
  }
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
  RandomProof(const Problem& problem, core::Random& random) : problem_(problem), random_(random) {
    proof_.sizes.assign(problem.sizes().begin(), problem.sizes().end());
    proof_.num_arcs = problem.num_arcs();
    ProofPart part;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) part.indices.push_back({k, i});
    }
    num_ = part.indices.size();
    for (const double cost : problem.costs()) scale_ = std::max(scale_, std::abs(cost));
    list_arcs();
    std::vector<std::uint32_t> all(num_);
    std::iota(all.begin(), all.end(), 0u);
    grow(part.steps, 0, all);
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

  // Positions of the arcs worth using; of others none.
  void list_arcs() {
    std::vector<std::uint32_t> first = {0};
    for (int k = 0; k < problem_.num_dimensions(); ++k)
      first.push_back(first.back() + problem_.size(k));
    for (std::size_t a = 0; a < problem_.num_arcs(); ++a) {
      arcs_.emplace_back();
      core::DoubleDouble excess(problem_.costs()[a]);
      bool is_free = true;  // to leave its indices alone
      for (int k = 0; k < problem_.num_dimensions(); ++k) {
        const Index i = problem_.indices(k)[a];
        if (i == 0) continue;
        const double alone = problem_.singleton_costs(k)[i];
        is_free = is_free && alone < kInfinity;
        if (is_free) excess.add(-alone);
        arcs_.back().push_back(first[static_cast<std::size_t>(k)] + i - 1);
      }
      if (is_free && !excess.negative()) arcs_.back().clear();
    }
  }

  static std::vector<std::uint32_t> without(std::vector<std::uint32_t> left,
                                            std::span<const std::uint32_t> done) {
    std::erase_if(left, [&](std::uint32_t p) { return std::ranges::find(done, p) != done.end(); });
    return left;
  }

  void grow_cover(std::vector<ProofStep>& steps,
                  int depth,
                  const std::vector<std::uint32_t>& left) {
    const std::uint32_t p = left[random_.below(left.size())];
    ProofStep step = cover(p, {});
    if (random_.below(2) == 0) step.uses.push_back(0);
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (std::ranges::find(arcs_[a], p) != arcs_[a].end() && random_.below(3) != 0)
        step.uses.push_back(a + 1);
    }
    const std::vector<std::uint32_t> uses = step.uses;
    steps.push_back(std::move(step));
    for (const std::uint32_t use : uses) {
      const std::vector<std::uint32_t> done = use == 0 ? std::vector{p} : arcs_[use - 1];
      grow(steps, depth + 1, without(left, done));
    }
    grow(steps, depth + 1, left);
  }

  // One group: what arcs connect with an index.
  void grow_split(std::vector<ProofStep>& steps,
                  int depth,
                  const std::vector<std::uint32_t>& left) {
    std::vector<std::uint32_t> group = {left[random_.below(left.size())]};
    for (std::size_t n = 0; n < group.size(); ++n) {
      for (const std::vector<std::uint32_t>& arc : arcs_) {
        if (std::ranges::find(arc, group[n]) == arc.end()) continue;
        for (const std::uint32_t p : without(arc, group)) {
          if (std::ranges::find(left, p) != left.end()) group.push_back(p);
        }
      }
    }
    steps.push_back(split({group}));
    grow(steps, depth + 1, group);
    grow(steps, depth + 1, without(left, group));
  }

  void grow(std::vector<ProofStep>& steps, int depth, const std::vector<std::uint32_t>& left) {
    for (std::size_t n = random_.below(3); n > 0; --n)
      steps.push_back({ProofRule::kFix, point(true), 3 * number(), 0, 0});
    const bool grows = depth < 4 && random_.below(3) != 0;
    if (grows && !left.empty() && random_.below(2) == 0) {
      random_.below(2) == 0 ? grow_cover(steps, depth, left) : grow_split(steps, depth, left);
    } else if (grows && num_ > 1) {
      const std::uint32_t first = position();
      const auto second = static_cast<std::uint32_t>((first + 1 + position() % (num_ - 1)) % num_);
      const ProofRule rule = random_.below(2) == 0 ? ProofRule::kTogether : ProofRule::kApart;
      steps.push_back({rule, {}, 0, first, second});
      grow(steps, depth + 1, left);
      grow(steps, depth + 1, left);
    } else if (const std::uint64_t kind = random_.below(3); kind > 0) {
      const ProofRule rule = kind == 1 ? ProofRule::kSearch : ProofRule::kCliques;
      steps.push_back({rule, point(true), 3 * number(), 0, 0});
    } else {
      steps.push_back({ProofRule::kBound, point(true), 0, 0, 0});
    }
  }

  const Problem& problem_;
  core::Random& random_;
  std::vector<std::vector<std::uint32_t>> arcs_;  // [arc]
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
