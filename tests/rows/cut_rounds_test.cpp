#include "rows/cut_rounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bnb/proof_log.hpp"
#include "core/random.hpp"
#include "cutting/cut_bound.hpp"
#include "cutting/cutting_support.hpp"
#include "nda/proof.hpp"
#include "rows/rows_support.hpp"
#include "support/components.hpp"

namespace nda::rows {
namespace {

using core::ArcId;
using core::Component;
using cutting::CutRow;
using cutting::fractional_component;
using cutting::triangle;

constexpr double kTie = 1e-9;

// Every kind of small component with three dimensions or more.
Component component_of(std::uint64_t seed) {
  if (seed % 2 == 0) return fractional_component(seed);
  Component component = support::random_component_of_any_kind(seed);
  return component.num_dimensions() > 2 ? component : fractional_component(seed);
}

CutRoundsResult run(const Component& component,
                    const CutRoundOptions& options,
                    const CutPointObserver& observer = {}) {
  const std::vector<double> none(component.num_slots(), 0.0);
  if (observer) return run_cut_rounds(component, none, options, observer);
  return run_cut_rounds(component, none, options, [&](const CutPoint&) { return options.cutoff; });
}

// What the multipliers of a result prove about the arcs that it leaves.
double proven(const Component& component, const CutRoundsResult& result) {
  const cutting::SlotIndex index(component, result.live);
  cutting::CutLister lister(component.num_arcs());
  std::vector<CutRow> rows = result.rows;
  for (CutRow& row : rows) row.entries = lister.list(row.cut, index);
  std::vector<double> reduced(component.num_arcs());
  return cutting::price(component, result.live, result.u, rows, {}, reduced);
}

// Optimum -1, relaxation -1.5, and the clique of the three indices closes that.
TEST(CutRounds, CloseTheGapOfTheTriangle) {
  CutRoundOptions options;
  options.cutoff = -0.9;
  const CutRoundsResult result = run(triangle(), options);
  EXPECT_LE(result.lower, -1 + kTie);
  EXPECT_NEAR(result.lower, -1, 2e-3);
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_EQ(result.rows[0].cut.slots, (std::vector<std::uint32_t>{1, 3, 5}));
}

TEST(CutRounds, BoundEveryPackingBelowTheCutoffAndKeepItsArcs) {
  std::size_t num_dropped = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = component_of(seed);
    const double best = support::best_cost(component);
    CutRoundOptions options;
    if (seed % 3 > 0) options.cutoff = best + (seed % 3 == 1 ? 0.5 : 5);
    const CutRoundsResult result = run(component, options);
    ASSERT_LE(result.lower, best + kTie);
    ASSERT_GE(proven(component, result), result.lower - kTie);
    ASSERT_LE(proven(component, result), best + kTie);
    std::vector<bool> live(component.num_arcs(), false);
    for (const ArcId a : result.live) live[a] = true;
    num_dropped += component.num_arcs() - result.live.size();
    if (seed % 10 > 0) continue;
    for (const core::Packing& packing : support::all_packings(component)) {
      if (packing.cost >= options.cutoff - kTie) continue;
      for (const ArcId a : packing.arcs) ASSERT_TRUE(live[a]) << "arc " << a;
    }
  }
  EXPECT_GT(num_dropped, 5000u);
}

// Never less than the multipliers they start from, and on the whole far less of the gap is left
// than the exact linear program without cuts leaves.
TEST(CutRounds, GainOnTheLinearProgram) {
  double with = 0;
  double without = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    cutting::Master master(
        component, core::all_arcs(component), cutting::no_multipliers(component));
    ASSERT_EQ(master.solve(kInfinity, {}), lp::Outcome::kOptimal);
    core::Random random(seed);
    const std::vector<double> u = support::feasible_multipliers(component, random);
    CutRoundOptions options;
    options.least_violation = 0.02;
    double last = support::sum_of(u) - 1e-7;
    const CutRoundsResult result =
        run_cut_rounds(component, u, options, [&](const CutPoint& point) {
          EXPECT_GE(point.lower, last);
          last = point.lower;
          return kInfinity;
        });
    const double best = support::best_cost(component);
    with += best - result.lower;
    without += best - master.lower();
  }
  EXPECT_LT(with, 0.6 * without);
}

TEST(CutRounds, OfTheBundleAreBoundsToo) {
  CutRoundOptions options;
  options.dual_method = DualMethod::kBundleTrust;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Component component = component_of(seed);
    EXPECT_LE(run(component, options).lower, support::best_cost(component) + kTie) << seed;
  }
  options.cutoff = -0.9;
  EXPECT_NEAR(run(triangle(), options).lower, -1, 2e-3);
}

TEST(CutRounds, WriteAProofThatTheCheckerFollows) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    bnb::ProofLog log(component, cutting::no_multipliers(component), 1e-9);
    CutRoundOptions options;
    options.cutoff = support::best_cost(component) + 0.5;
    options.proof = &log;
    const CutRoundsResult result = run(component, options);
    log.bound(result.u, cutting::proof_cuts(result.rows));
    const Problem problem = support::to_problem(component);
    Proof proof;
    proof.sizes.assign(problem.sizes().begin(), problem.sizes().end());
    proof.num_arcs = problem.num_arcs();
    proof.parts = {log.take()};
    const ProofReport report = check_proof(problem, proof);
    ASSERT_TRUE(report.passed()) << report.fault;
    ASSERT_NEAR(report.lower_bound, result.lower, 1e-6);
  }
}

TEST(CutRounds, TakeTheSameStepsTwice) {
  const Component component = support::large_component(3);
  const CutRoundsResult one = run(component, {});
  const CutRoundsResult other = run(component, {});
  EXPECT_GT(one.rounds, 1);
  EXPECT_EQ(one.u, other.u);
  EXPECT_EQ(one.lower, other.lower);
}

TEST(CutRounds, StopAtTheCutoff) {
  CutRoundOptions options;
  options.cutoff = -1.6;  // below the relaxation
  const CutRoundsResult result = run(triangle(), options);
  EXPECT_GE(result.lower, options.cutoff);
  EXPECT_EQ(result.rounds, 1);
}

TEST(CutRounds, LeaveEverythingOpenWithoutTime) {
  CutRoundOptions options;
  options.deadline = core::Deadline(0);
  const CutRoundsResult result = run(triangle(), options);
  EXPECT_EQ(result.lower, -kInfinity);
  EXPECT_EQ(result.rounds, 0);
  EXPECT_EQ(result.live.size(), 3u);
}

}  // namespace
}  // namespace nda::rows
