#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/option_table.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

// Method::kRelaxation: relaxation and recovery, nothing else.

namespace nda {
namespace {

using ::testing::AnyOf;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::Not;

// Sparse, one component: its bound is not met by a packing on the way.
Problem gapped_problem(int num_dimensions) {
  support::RandomProblemOptions shape;
  shape.sizes.assign(static_cast<std::size_t>(num_dimensions), 6);
  shape.num_arcs = 60;
  return support::random_problem(1, shape);
}

TEST(Relaxation, RecoversAtEveryStepInThreeDimensions) {
  Options options;
  options.method = Method::kRelaxation;
  options.relaxation.max_evaluations = 25;
  options.relaxation.relative_tolerance = 0;
  const Solution three = solve(gapped_problem(3), options);
  EXPECT_GT(three.stats.dual_evaluations, 1);
  EXPECT_EQ(three.stats.recoveries, three.stats.dual_evaluations);
  const Solution four = solve(gapped_problem(4), options);
  EXPECT_GT(four.stats.dual_evaluations, 20);
  EXPECT_GE(four.stats.recoveries, 3) << "at 1, 11, 21";
  EXPECT_LE(four.stats.recoveries, 4) << "and at the best";
}

TEST(Relaxation, DoesNothingElse) {
  Options options;
  options.method = Method::kRelaxation;
  std::vector<std::string> events;
  options.progress = [&](const Progress& progress) {
    events.push_back(progress.event);
    return true;
  };
  for (const int num_dimensions : {3, 4, 5}) solve(gapped_problem(num_dimensions), options);
  EXPECT_THAT(events, Not(IsEmpty()));
  EXPECT_THAT(events, Each(AnyOf("relaxation", "recursive recovery")));
}

TEST(Relaxation, ProvesWhatHasNoGap) {
  Options options;
  options.method = Method::kRelaxation;
  for (const support::TinyProblem& tiny :
       {support::crossing_tracks(), support::two_components(), support::zero_zero_cell()}) {
    SCOPED_TRACE(tiny.name);
    EXPECT_EQ(solve(tiny.problem, options).status, Status::kOptimal);
  }
  // A gap of 1/2 is none where all costs are whole.
  EXPECT_EQ(solve(support::odd_cycle().problem, options).status, Status::kOptimal);
}

// It ends before the limit, as the next evaluation and the certificate would end after it.
TEST(Relaxation, IsCutShortByTheTimeLimit) {
  for (const char* dual_method : {"bundle", "subgradient", "volume", "coordinate"}) {
    for (const int kept_sets : {2, 3}) {
      SCOPED_TRACE(std::string(dual_method) + ", kept sets " + std::to_string(kept_sets));
      Options options;
      core::set_option("relaxation.dual_method", dual_method, options);
      options.method = Method::kRelaxation;
      options.relaxation.kept_sets = kept_sets;
      options.relaxation.max_evaluations = 1'000'000;
      options.relaxation.relative_tolerance = 0;
      options.time_limit_s = 0.01;
      const Solution solution = solve(hard_problem(), options);
      EXPECT_EQ(solution.status, Status::kTimeLimit);
      EXPECT_THAT(check(hard_problem(), solution).faults, IsEmpty());
    }
  }
}

}  // namespace
}  // namespace nda
