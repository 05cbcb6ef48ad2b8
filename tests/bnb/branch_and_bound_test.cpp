#include "bnb/branch_and_bound.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bnb/fakes.hpp"
#include "nda/proof.hpp"
#include "support/components.hpp"

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

using Bound = std::function<NodeBound(const Component&, std::span<const double>, double)>;
using Reduce = std::function<Reduction(const Component&, const NodeBound&, double)>;

struct Fakes {
  const char* name;
  Bound bound;
  Reduce reduce;
};

void PrintTo(const Fakes& fakes, std::ostream* out) {
  *out << fakes.name;
}

// A component cut out of a larger one, so that its arcs have other numbers there.
struct Cut {
  Component whole;
  Component part;
};

Cut random_cut(std::uint64_t seed) {
  Cut cut;
  cut.whole = support::random_component_of_any_kind(seed);
  core::Random random(seed);
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < cut.whole.num_arcs(); ++a) {
    if (random.below(6) != 0) arcs.push_back(a);
  }
  cut.part = core::Cutter().cut(cut.whole, arcs);
  return cut;
}

// What holds however the search ended; best: the optimum of the part.
void expect_sound(const Cut& cut, double best, double cutoff, const SearchResult& result) {
  EXPECT_LE(std::min(result.lower, cutoff), best + kTie);
  if (!result.found) {
    if (result.complete) {
      EXPECT_GE(best, cutoff - kTie);
    }
    return;
  }
  EXPECT_EQ(support::packing_fault(cut.whole, result.best), "");
  for (const ArcId a : result.best.arcs) {
    EXPECT_TRUE(std::binary_search(cut.part.arc_origin.begin(), cut.part.arc_origin.end(), a));
  }
  EXPECT_LT(result.best.cost, cutoff + kTie);
}

class BranchAndBound : public ::testing::TestWithParam<Fakes> {
 protected:
  SearchResult search(const Component& component,
                      std::span<const double> u,
                      double cutoff,
                      const BranchLimits& limits) const {
    return branch_and_bound(component, u, cutoff, {GetParam().bound, GetParam().reduce}, limits);
  }
};

TEST_P(BranchAndBound, AgreesWithBruteForceForAnyMultipliersAndCutoff) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE(seed);
    const Cut cut = random_cut(seed);
    if (cut.part.num_arcs() > 13) continue;
    ++num_compared;
    core::Random random(seed);
    const std::vector<double> u =
        support::feasible_multipliers(cut.part, random, random.below(3) == 0 ? 3.0 : 0.0);
    const double best = support::best_cost(cut.part);
    BranchLimits limits = branch_always();
    limits.enumeration_arcs = 4 * random.below(3);
    limits.enumeration_nodes = 1 + static_cast<std::int64_t>(random.below(30));
    for (const double cutoff : {kInfinity, best + random.uniform(0.001, 5), best - 0.001, 0.25}) {
      SCOPED_TRACE(cutoff);
      const SearchResult result = search(cut.part, u, cutoff, limits);
      EXPECT_TRUE(result.complete);
      EXPECT_EQ(result.found, best < cutoff);
      expect_sound(cut, best, cutoff, result);
      if (result.found) {
        EXPECT_NEAR(result.best.cost, best, kTie);
      }
      EXPECT_GE(result.lower, std::min(best, cutoff) - 3 * kTie) << "proves the most it can";
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(num_compared, 600);
}

TEST_P(BranchAndBound, StaysSoundUnderANodeLimit) {
  int num_incomplete = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE(seed);
    const Cut cut = random_cut(seed);
    if (cut.part.num_arcs() > 13) continue;
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(cut.part, random, 2);
    const double best = support::best_cost(cut.part);
    BranchLimits limits = branch_always();
    limits.max_nodes = static_cast<std::int64_t>(random.below(12));
    limits.enumeration_arcs = 4 * random.below(3);
    limits.enumeration_nodes = 5;
    const double cutoff = random.below(2) == 0 ? kInfinity : best + random.uniform(-1, 3);
    const SearchResult result = search(cut.part, u, cutoff, limits);
    expect_sound(cut, best, cutoff, result);
    if (result.complete && result.found) {
      EXPECT_NEAR(result.best.cost, best, kTie);
    }
    num_incomplete += !result.complete;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_incomplete, 100);
}

TEST_P(BranchAndBound, StaysSoundWhenInterruptedAtAnyMoment) {
  int num_incomplete = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    const Cut cut = random_cut(seed);
    if (cut.part.num_arcs() > 13) continue;
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(cut.part, random, 2);
    std::stop_source stop;
    BranchLimits limits = branch_always();
    limits.deadline = core::Deadline(60, stop.get_token());
    std::uint64_t calls_left = random.below(6);
    const Bound bound = [&](const Component& node, std::span<const double> warm, double cutoff) {
      if (calls_left-- == 0) stop.request_stop();
      return GetParam().bound(node, warm, cutoff);
    };
    const SearchResult result =
        branch_and_bound(cut.part, u, kInfinity, {bound, GetParam().reduce}, limits);
    const double best = support::best_cost(cut.part);
    expect_sound(cut, best, kInfinity, result);
    if (result.complete && result.found) {
      EXPECT_NEAR(result.best.cost, best, kTie);
    }
    num_incomplete += !result.complete;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_incomplete, 50);
}

// The answer may be off by the gap, however many parts it is put together from, and the bound says
// so.
TEST_P(BranchAndBound, MissesTheOptimumByTheGapAtMost) {
  int num_missed = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE(seed);
    const Cut cut = random_cut(seed);
    if (cut.part.num_arcs() > 13) continue;
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(cut.part, random);
    const double best = support::best_cost(cut.part);
    BranchLimits limits = branch_always();
    limits.gap = random.uniform(0.1, 6);
    const SearchResult result = search(cut.part, u, kInfinity, limits);
    EXPECT_TRUE(result.complete);
    ASSERT_TRUE(result.found);
    expect_sound(cut, best, kInfinity, result);
    EXPECT_LE(result.best.cost, best + limits.gap + kTie);
    EXPECT_LE(result.lower, best + kTie);
    num_missed += result.best.cost > best + kTie;
    if (HasFailure()) return;
  }
  if (std::string(GetParam().name).find("Oracle") == std::string::npos) {
    EXPECT_GT(num_missed, 0);
  }
}

// Integer costs: nothing lies between the best and the next cheaper integer, so a margin of nearly
// 1 loses nothing.
TEST_P(BranchAndBound, MarginOfNearlyTheGridLosesNothing) {
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomComponentOptions options;
    options.integer = true;
    options.num_arcs = 12;
    const Component component = support::random_component(seed, options);
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    const double best = support::best_cost(component);
    BranchLimits limits = branch_always();
    limits.margin = 0.999;
    const SearchResult result = search(component, u, 0.5, limits);
    EXPECT_TRUE(result.complete);
    ASSERT_TRUE(result.found);
    EXPECT_EQ(result.best.cost, best);
    EXPECT_NEAR(result.lower, best, 2 * kTie);
    if (HasFailure()) return;
  }
}

// Without arcs of positive cost, which no proof knows.
Component worthwhile_component(std::uint64_t seed, bool integer) {
  core::Random random(seed);
  support::RandomComponentOptions options;
  options.sizes.clear();
  for (std::size_t k = 2 + random.below(4); k > 0; --k)
    options.sizes.push_back(static_cast<Index>(1 + random.below(5)));
  options.num_arcs = static_cast<int>(1 + random.below(14));
  options.positive_share = 0;
  options.integer = integer;
  return support::random_component(seed, options);
}

bool has_worthless_arcs(const Component& component) {
  return std::any_of(
      component.costs.begin(), component.costs.end(), [](double c) { return c >= 0; });
}

TEST_P(BranchAndBound, WritesDownWhatItProves) {
  int num_proofs = 0, num_branched = 0, num_split = 0;
  for (std::uint64_t seed = 0; seed < 2400; ++seed) {
    SCOPED_TRACE(seed);
    const bool integer = seed % 2 == 0;
    const Component component = worthwhile_component(seed, integer);
    if (has_worthless_arcs(component)) continue;
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    const double best = support::best_cost(component);
    BranchLimits limits = branch_always();
    limits.margin = integer ? 1 - 1e-6 : kTie;
    limits.enumeration_arcs = 4 * random.below(3);
    // An open node shows what its own multipliers prove, even if those above proved more.
    const bool inherits = std::string(GetParam().name).find("Fresh") == std::string::npos;
    if (inherits && random.below(8) == 0)
      limits.max_nodes = static_cast<std::int64_t>(random.below(12));
    const double cutoff = random.below(3) == 0 ? best + random.uniform(-2, 5) : 0.5;
    const SearchResult silent = search(component, u, cutoff, limits);
    ProofLog log(component, std::vector<double>(component.num_slots(), 0.0), kTie / 16);
    limits.proof = &log;
    const SearchResult result = search(component, u, cutoff, limits);
    EXPECT_EQ(result.nodes, silent.nodes);
    EXPECT_EQ(result.lower, silent.lower);
    const Problem problem = support::to_problem(component);
    Proof proof{{problem.sizes().begin(), problem.sizes().end()}, problem.num_arcs(), 0, {}};
    if (integer) proof.grid = 1;
    proof.parts = {log.take()};
    const ProofReport report = check_proof(problem, proof);
    EXPECT_EQ(report.fault, "");
    EXPECT_LE(report.lower_bound, best + 1e-12 * std::abs(best));
    EXPECT_GE(report.lower_bound, std::min(result.lower, cutoff) - 8 * kTie);
    ++num_proofs;
    for (const ProofStep& step : proof.parts[0].steps) {
      num_branched += step.rule == ProofRule::kCover;
      num_split += step.rule == ProofRule::kSplit;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(num_proofs, 1000);
  EXPECT_GT(num_branched + num_split, 500);
}

INSTANTIATE_TEST_SUITE_P(
    Fakes,
    BranchAndBound,
    ::testing::Values(Fakes{"WarmWhole", keep_the_warm_multipliers, change_nothing},
                      Fakes{"WarmSplit", keep_the_warm_multipliers, split_only},
                      Fakes{"WarmFixed", keep_the_warm_multipliers, fix_and_split},
                      Fakes{"FreshSplit", start_afresh_from_random_multipliers, split_only},
                      Fakes{"FreshFixed", start_afresh_from_random_multipliers, fix_and_split},
                      Fakes{"OracleSplit", know_the_best_packing, split_only},
                      Fakes{"OracleFixed", know_the_best_packing, fix_and_split}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace nda::bnb
