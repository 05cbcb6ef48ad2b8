#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "core/clock.hpp"
#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "solve/medium_problems.hpp"
#include "support/brute_force.hpp"
#include "support/build_kind.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

constexpr double kTie = 1e-9;

const Problem& problem_of_many_components() {
  return planted(PlantedSingletons::kFree).problem;
}

// What must hold whatever stopped the solver.
void expect_usable(const Problem& problem, const Solution& solution) {
  const CheckReport report = check(problem, solution);
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_LE(solution.lower_bound, solution.cost);
  EXPECT_TRUE(std::isfinite(solution.lower_bound));
  EXPECT_EQ(solution.proven, solution.status == Status::kOptimal);
  EXPECT_EQ(solution.stats.bound_by_branching,
            solution.lower_bound > solution.stats.certificate_bound);
  for (const ComponentReport& component : solution.components) {
    EXPECT_EQ(component.proven, component.status == Status::kOptimal);
  }
}

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Wall time cannot be promised on a machine that is busy with other things; the time this thread
// worked can, and on an idle machine the two are one.
double seconds_of_work(const std::function<void()>& action) {
  const double start = cpu_seconds();
  action();
  return cpu_seconds() - start;
}

class TimeLimits : public ::testing::TestWithParam<int> {};

TEST_P(TimeLimits, AreObeyed) {
  Options options;
  options.time_limit_s = 0.001 * GetParam();
  const double allowed =
      options.time_limit_s + support::kSlowdown * std::max(0.005, 0.01 * options.time_limit_s);
  const Problem& problem = hard_problem();
  double least = kInfinity;
  for (int attempt = 0; attempt < 3 && least > allowed; ++attempt) {
    Solution solution;
    least = std::min(least, seconds_of_work([&] { solution = solve(problem, options); }));
    EXPECT_EQ(solution.status, Status::kTimeLimit);
    EXPECT_TRUE(solution.reason.empty());
    expect_usable(problem, solution);
  }
  EXPECT_LE(least, allowed);
}

INSTANTIATE_TEST_SUITE_P(Milliseconds, TimeLimits, ::testing::Values(1, 2, 5, 10, 20, 50, 200));

TEST(TimeLimit, ThatIsNotReachedChangesNothing) {
  Options options;
  options.time_limit_s = 1000;
  const Solution limited = solve(problem_of_many_components(), options);
  const Solution free = solve(problem_of_many_components());
  EXPECT_EQ(limited.status, Status::kOptimal);
  EXPECT_EQ(limited.solutions[0].arcs, free.solutions[0].arcs);
  EXPECT_EQ(limited.lower_bound, free.lower_bound);
}

TEST(TimeLimit, OfNoTimeStillGivesABoundAndTheSingletons) {
  Options options;
  options.time_limit_s = 1e-9;
  const Solution solution = solve(hard_problem(), options);
  EXPECT_EQ(solution.status, Status::kTimeLimit);
  expect_usable(hard_problem(), solution);
  ASSERT_EQ(solution.solutions.size(), 1u);
}

// Costs that are small multiples of the smallest number: steps of the dual method underflow.
TEST(TimeLimit, IsNotNeededWhereCostsAreNextToNothing) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    ProblemBuilder builder({3, 2, 2, 3, 2});
    for (int a = 0; a < 26; ++a) {
      std::vector<Index> tuple;
      for (const Index size : {3, 2, 2, 3, 2}) {
        tuple.push_back(static_cast<Index>(random.below(size + 1)));
      }
      if (std::all_of(tuple.begin(), tuple.end(), [](Index i) { return i == 0; })) continue;
      builder.add_arc(tuple, kLeast * (static_cast<double>(random.below(7)) - 3));
    }
    const Problem problem = std::move(builder).build();
    for (const std::size_t exact_arcs : {0, 128}) {
      Options options;
      options.branch.exact_arcs = exact_arcs;
      options.branch.max_nodes = 1000;
      const Solution solution = solve(problem, options);
      EXPECT_THAT(check(problem, solution).faults, IsEmpty());
      EXPECT_LE(solution.lower_bound, solution.cost);
    }
  }
}

TEST(TimeLimit, GivesNoSolutionWhereNoneWasFound) {
  const Problem problem = support::infeasible_by_parity().problem;
  Options options;
  options.time_limit_s = 1e-9;
  const Solution solution = solve(problem, options);
  EXPECT_EQ(solution.status, Status::kTimeLimit);
  EXPECT_THAT(solution.solutions, IsEmpty());
  EXPECT_EQ(solution.cost, kInfinity);
  EXPECT_TRUE(std::isfinite(solution.lower_bound));
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

TEST(StopToken, ThatWasSetBeforeStopsAtOnce) {
  std::stop_source source;
  source.request_stop();
  Options options;
  options.stop = source.get_token();
  const Solution solution = solve(hard_problem(), options);
  EXPECT_EQ(solution.status, Status::kInterrupted);
  expect_usable(hard_problem(), solution);
}

TEST(StopToken, StopsASolveInAnotherThread) {
  std::stop_source source;
  Options options;
  options.stop = source.get_token();
  options.time_limit_s = 60;
  Solution solution;
  const core::Stopwatch watch;
  std::thread solver([&] { solution = solve(hard_problem(), options); });
  std::this_thread::sleep_for(std::chrono::milliseconds(30));
  source.request_stop();
  solver.join();
  EXPECT_EQ(solution.status, Status::kInterrupted);
  EXPECT_LT(watch.seconds(), 20);
  expect_usable(hard_problem(), solution);
}

TEST(ProgressCallback, ThatReturnsFalseStops) {
  for (const int calls_wanted : {1, 2}) {
    SCOPED_TRACE(calls_wanted);
    int calls = 0;
    Options options;
    options.time_limit_s = 60;
    options.progress = [&](const Progress&) { return ++calls < calls_wanted; };
    const Solution solution = solve(hard_problem(), options);
    EXPECT_EQ(solution.status, Status::kInterrupted);
    EXPECT_EQ(calls, calls_wanted) << "it is not called again";
    expect_usable(hard_problem(), solution);
  }
}

TEST(ProgressCallback, SeesTheCostFallAndTheBoundRise) {
  for (const Problem* problem : {&hard_problem(), &problem_of_many_components()}) {
    Options options;
    options.time_limit_s = 0.3;
    std::vector<Progress> seen;
    options.progress = [&](const Progress& progress) {
      seen.push_back(progress);
      return true;
    };
    const Solution solution = solve(*problem, options);
    ASSERT_FALSE(seen.empty());
    for (std::size_t i = 1; i < seen.size(); ++i) {
      EXPECT_LE(seen[i].cost, seen[i - 1].cost);
      EXPECT_GE(seen[i].lower_bound, seen[i - 1].lower_bound);
      EXPECT_GE(seen[i].seconds, seen[i - 1].seconds);
      EXPECT_GE(seen[i].components_done, seen[i - 1].components_done);
      EXPECT_NE(std::string(seen[i].event), "");
    }
    for (const Progress& progress : seen) {
      EXPECT_EQ(progress.num_components, solution.num_components);
      EXPECT_LE(progress.components_done, progress.num_components);
      EXPECT_LE(progress.lower_bound, solution.cost + 1e-6);
      EXPECT_GE(progress.cost, solution.cost - 1e-6);
    }
    EXPECT_NEAR(seen.back().cost, solution.cost, 1e-6);
  }
}

TEST(ProgressCallback, IsNeverCalledConcurrently) {
  Options options;
  options.num_threads = 4;
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  options.progress = [&](const Progress&) {
    most = std::max<int>(most, ++inside);
    std::this_thread::yield();
    --inside;
    return true;
  };
  solve(problem_of_many_components(), options);
  EXPECT_EQ(most, 1);
}

// Perfect matchings only, and a heuristic that is not made for them.
TEST(ProgressCallback, SeesNoCostBeforeASolutionIsKnown) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    SCOPED_TRACE(seed);
    Map3Options map3;
    map3.size = 10;
    map3.seed = seed;
    const Problem problem = generate_map3(map3).problem;
    const double dearest = *std::max_element(problem.costs().begin(), problem.costs().end());
    Options options;
    std::vector<Progress> seen;
    options.progress = [&](const Progress& progress) {
      seen.push_back(progress);
      return true;
    };
    const Solution solution = solve(problem, options);
    ASSERT_FALSE(seen.empty());
    for (const Progress& progress : seen) {
      EXPECT_TRUE(progress.cost == kInfinity || progress.cost <= 10 * dearest) << progress.cost;
    }
    EXPECT_EQ(seen.back().cost, solution.cost);
  }
}

TEST(ProgressCallback, SeesNoCostOfAnInfeasibleProblem) {
  for (const support::TinyProblem& tiny : support::all_tiny_problems()) {
    SCOPED_TRACE(tiny.name);
    Options options;
    double least = kInfinity;
    options.progress = [&](const Progress& progress) {
      least = std::min(least, progress.cost);
      return true;
    };
    solve(tiny.problem, options);
    if (!tiny.optimum) {
      EXPECT_EQ(least, kInfinity);
    }
  }
}

TEST(ProgressCallback, SeesTheLastComponentDone) {
  for (const Problem* problem : {&problem_of_many_components(), &small_hard_problem()}) {
    Options options;
    Progress last;
    options.progress = [&](const Progress& progress) {
      last = progress;
      return true;
    };
    EXPECT_EQ(solve(*problem, options).status, Status::kOptimal);
    EXPECT_EQ(last.components_done, last.num_components);
  }
}

TEST(NodeLimit, StopsBranching) {
  for (const std::int64_t max_nodes : {0, 1, 3}) {
    SCOPED_TRACE(max_nodes);
    Options options;
    options.branch.max_nodes = max_nodes;
    options.relaxation.max_evaluations = 20;
    const Solution solution = solve(small_hard_problem(), options);
    EXPECT_EQ(solution.status, Status::kNodeLimit);
    EXPECT_LE(solution.stats.nodes, max_nodes);
    expect_usable(small_hard_problem(), solution);
  }
}

TEST(NodeLimit, CountsEnumerationToo) {
  for (const std::int64_t max_nodes : {0, 1, 3}) {
    Options options;
    options.branch.max_nodes = max_nodes;
    options.method = Method::kExact;
    const Solution solution = solve(small_hard_problem(), options);
    EXPECT_EQ(solution.status, Status::kNodeLimit);
    EXPECT_LE(solution.stats.nodes, max_nodes);
    expect_usable(small_hard_problem(), solution);
  }
}

TEST(IterationLimit, EndsTheRelaxationAlone) {
  Options options;
  options.method = Method::kRelaxation;
  options.relaxation.max_evaluations = 15;
  const Solution solution = solve(hard_problem(), options);
  EXPECT_EQ(solution.status, Status::kIterationLimit);
  EXPECT_EQ(solution.stats.dual_evaluations, 15);
  EXPECT_EQ(solution.stats.nodes, 0);
  EXPECT_FALSE(solution.stats.bound_by_branching);
  expect_usable(hard_problem(), solution);
}

// Options that end a solve early in one of all ways.
Options limited_options(core::Random& random) {
  Options options;
  options.branch.exact_arcs = random.below(2) == 0 ? 0 : 20;
  options.relaxation.max_evaluations = 1 + static_cast<int>(random.below(20));
  options.search.local_search = random.below(2) == 0;
  switch (random.below(5)) {
    case 0:
      options.time_limit_s = std::pow(10, random.uniform(-9, -3));
      break;
    case 1:
      options.relative_gap = random.below(4) == 0 ? kInfinity : std::pow(10, random.uniform(-3, 1));
      break;
    case 2:
      options.branch.max_nodes = static_cast<std::int64_t>(random.below(4));
      break;
    case 3:
      options.method = Method::kRelaxation;
      break;
    default:
      const auto calls = std::make_shared<std::uint64_t>(random.below(8));
      options.progress = [calls](const Progress&) { return (*calls)-- > 0; };
  }
  return options;
}

// Whether this status can follow from these options.
bool may_end_so(Status status, const Options& options) {
  switch (status) {
    case Status::kOptimal:
    case Status::kInfeasible:
      return true;
    case Status::kGapReached:
      return options.relative_gap > 0;
    case Status::kTimeLimit:
      return options.time_limit_s < kInfinity;
    case Status::kIterationLimit:
      return options.method == Method::kRelaxation;
    case Status::kNodeLimit:
      return options.branch.max_nodes < std::numeric_limits<std::int64_t>::max();
    case Status::kInterrupted:
      return options.progress != nullptr;
    case Status::kPrecisionLost:
      return false;
  }
  return false;
}

TEST(Status, SaysWhyEveryComponentEnded) {
  std::map<Status, int> count;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    support::RandomProblemOptions shape;
    shape.sizes.assign(3 + random.below(2), 5);
    shape.num_arcs = 10 + static_cast<int>(random.below(30));
    shape.singletons = static_cast<support::SingletonKind>(random.below(4));
    shape.sign = static_cast<support::SignKind>(random.below(3));
    const Problem problem = support::random_problem(seed, shape);
    const Options options = limited_options(random);
    const Solution solution = solve(problem, options);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
    EXPECT_TRUE(may_end_so(solution.status, options)) << to_string(solution.status);
    for (const ComponentReport& component : solution.components) {
      EXPECT_EQ(component.proven, component.status == Status::kOptimal);
      EXPECT_TRUE(may_end_so(component.status, options)) << to_string(component.status);
      ++count[component.status];
    }
    if (HasFailure()) return;
  }
  EXPECT_EQ(count.size(), 7u) << "all but precision_lost";
}

// Random problems of all signs, and the gap asked for.
struct GapCase {
  Problem problem;
  double optimum;
  Options options;
};

GapCase gap_case(std::uint64_t seed) {
  core::Random random(seed);
  support::RandomProblemOptions problem;
  problem.sizes.assign(3 + random.below(2), 4);
  problem.num_arcs = 24;
  problem.singletons = static_cast<support::SingletonKind>(random.below(4));
  problem.sign = static_cast<support::SignKind>(random.below(3));
  problem.plant = true;
  GapCase result{support::random_problem(seed, problem), 0, {}};
  result.optimum = support::brute_force(result.problem)->cost;
  result.options.relative_gap = std::pow(10, random.uniform(-4, 0.5));
  result.options.branch.exact_arcs = random.below(2) == 0 ? 0 : 60;
  result.options.relaxation.max_evaluations = 1 + static_cast<int>(random.below(20));
  result.options.relaxation.recovery_interval = 1 + static_cast<int>(random.below(50));
  result.options.search.local_search = random.below(2) == 0;
  return result;
}

TEST(RelativeGap, IsReachedAndTheBoundHolds) {
  int num_stopped_early = 0;
  for (std::uint64_t seed = 0; seed < 2500; ++seed) {
    SCOPED_TRACE(seed);
    const GapCase tested = gap_case(seed);
    SCOPED_TRACE(tested.options.relative_gap);
    const Solution solution = solve(tested.problem, tested.options);
    EXPECT_TRUE(solution.status == Status::kGapReached || solution.status == Status::kOptimal)
        << to_string(solution.status);
    expect_usable(tested.problem, solution);
    EXPECT_LE(solution.lower_bound, tested.optimum + 1e-7);
    EXPECT_GE(solution.cost, tested.optimum - 1e-7);
    EXPECT_LE(solution.gap(), tested.options.relative_gap * std::abs(solution.cost) + kTie);
    num_stopped_early += solution.status == Status::kGapReached;
    if (HasFailure()) return;
  }
  EXPECT_GT(num_stopped_early, 50);
}

TEST(RelativeGap, MayBeInfinite) {
  Options options;
  options.relative_gap = kInfinity;
  options.branch.exact_arcs = 0;
  const Solution solution = solve(hard_problem(), options);
  EXPECT_EQ(solution.status, Status::kGapReached);
  expect_usable(hard_problem(), solution);
}

}  // namespace
}  // namespace nda
