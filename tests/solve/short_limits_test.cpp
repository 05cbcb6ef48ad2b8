#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <functional>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/brute_force.hpp"
#include "support/build_kind.hpp"
#include "support/random_problems.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

// Wherever a limit strikes, the answer is right as far as it goes.
void expect_right(const Problem& problem, const Solution& solution) {
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  EXPECT_EQ(solution.proven, solution.status == Status::kOptimal);
  EXPECT_LE(solution.lower_bound, solution.cost);
  EXPECT_GT(solution.lower_bound, -kInfinity);
  EXPECT_EQ(solution.solutions.empty(), solution.cost == kInfinity);
}

Options random_options(core::Random& random) {
  Options options;
  options.time_limit_s = std::pow(10, random.uniform(-5, -2.7));
  options.seed = random.below(1000);
  options.relative_gap = random.below(4) == 0 ? 0.05 : 0;
  options.method = static_cast<Method>(random.below(3));
  options.branch.exact_arcs = random.below(2) == 0 ? 0 : 128;
  options.search.local_search = random.below(2) == 0;
  options.relaxation.dual_method = static_cast<DualMethod>(random.below(4));
  options.relaxation.recovery = static_cast<RecoveryMethod>(random.below(3));
  options.relaxation.assign2d = static_cast<Assign2dMethod>(random.below(2));
  return options;
}

TEST(ShortTimeLimits, GiveRightAnswersOfSmallProblems) {
  core::Random random(1);
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase tested = support::random_case(seed);
    SCOPED_TRACE(tested.description);
    Options options = random_options(random);
    options.time_limit_s *= 0.03;
    const Solution solution = solve(tested.problem, options);
    if (solution.status == Status::kPrecisionLost) continue;
    if (solution.status != Status::kInfeasible) expect_right(tested.problem, solution);
    const auto best = support::brute_force(tested.problem);
    if (best) {
      EXPECT_NE(solution.status, Status::kInfeasible);
      const double tolerance = 1e-9 * (1 + std::abs(best->cost));
      EXPECT_LE(solution.lower_bound, best->cost + tolerance);
      EXPECT_GE(solution.cost, best->cost - tolerance);
    } else {
      EXPECT_THAT(solution.solutions, IsEmpty());
    }
    if (HasFailure()) return;
  }
}

TEST(ShortTimeLimits, GiveRightAnswersOfMediumProblems) {
  core::Random random(2);
  const Instance* const known[] = {&gadgets(),
                                   &planted(PlantedSingletons::kFree),
                                   &planted(PlantedSingletons::kPriced),
                                   &planted(PlantedSingletons::kForbidden)};
  for (int attempt = 0; attempt < 800; ++attempt) {
    const Instance& instance = *known[attempt % 4];
    SCOPED_TRACE(attempt);
    const Solution solution = solve(instance.problem, random_options(random));
    expect_right(instance.problem, solution);
    EXPECT_LE(solution.lower_bound, *instance.optimum + 1e-6);
    if (HasFailure()) return;
  }
  for (int attempt = 0; attempt < 200; ++attempt) {
    SCOPED_TRACE(attempt);
    expect_right(hard_problem(), solve(hard_problem(), random_options(random)));
    if (HasFailure()) return;
  }
}

TEST(ShortTimeLimits, MayBeShorterThanAnything) {
  Options options;
  options.time_limit_s = 1e-300;
  for (const PlantedSingletons kind : {PlantedSingletons::kFree, PlantedSingletons::kForbidden}) {
    const Problem& problem = planted(kind).problem;
    const Solution solution = solve(problem, options);
    EXPECT_EQ(solution.status, Status::kTimeLimit);
    expect_right(problem, solution);
  }
}

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// 100,000 arcs in one component.
Problem large_problem(int num_dimensions) {
  PlantedOptions options;
  options.dimensions = num_dimensions;
  options.size = 2000;
  options.arcs = 100000;
  return generate_planted(options).problem;
}

// Time of work from the moment when `ask` first says so until the solve ends.
double reaction_s(const Problem& problem,
                  Options options,
                  const std::function<bool(Options&)>& ask,
                  Solution& solution) {
  double asked = 0;
  options.progress = [&](const Progress&) {
    if (asked == 0) asked = cpu_seconds();
    return ask(options);
  };
  solution = solve(problem, options);
  return cpu_seconds() - asked;
}

// What include/nda/options.hpp promises of a limit holds for a request to stop as well.
TEST(Stopping, IsAsQuickAsALimit) {
  for (const int num_dimensions : {3, 5}) {
    SCOPED_TRACE(num_dimensions);
    const Problem problem = large_problem(num_dimensions);
    const double allowed =
        support::kSlowdown *
        std::max(0.005, 1e-7 * static_cast<double>(problem.num_arcs() + problem.num_indices()));
    for (const bool by_token : {false, true}) {
      SCOPED_TRACE(by_token);
      double least = kInfinity;
      for (int attempt = 0; attempt < 3 && least > allowed; ++attempt) {
        std::stop_source source;
        Options options;
        options.stop = source.get_token();
        const auto ask = [&](Options&) {
          if (by_token) source.request_stop();
          return by_token;
        };
        Solution solution;
        least = std::min(least, reaction_s(problem, options, ask, solution));
        EXPECT_EQ(solution.status, Status::kInterrupted);
        expect_right(problem, solution);
      }
      EXPECT_LE(least, allowed);
    }
  }
}

}  // namespace
}  // namespace nda
