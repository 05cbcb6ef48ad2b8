#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "nda/check.hpp"
#include "nda/solve.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

// Arcs (i, i, i) that cost 1 and (i, i + 1, i) that gain 1: the only solution takes the former and
// costs n.  Leaving two or three indices uncovered saves nearly 2 n, more than a penalty of 64 for
// each where n is 200.
Problem chain(Index n, bool is_closed) {
  ProblemBuilder builder({n, n, n});
  for (Index i = 1; i <= n; ++i) {
    if (is_closed || i > 1) builder.add_arc({i, i, i}, 1);
    if (i < n) builder.add_arc({i, i + 1, i}, -1);
    builder.add_arc({i, 0, 0}, kInfinity);
    builder.add_arc({0, i, 0}, kInfinity);
    builder.add_arc({0, 0, i}, kInfinity);
  }
  return std::move(builder).build();
}

TEST(Penalty, IsRaisedWhereTheFirstOneIsNotEnough) {
  for (const Index n : {3, 50, 200, 400}) {
    const Problem problem = chain(n, true);
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kOptimal) << n;
    EXPECT_NEAR(solution.cost, n, 1e-9);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

TEST(Penalty, TooLowProvesNothingInfeasible) {
  const Problem problem = chain(300, false);
  const Solution solution = solve(problem);
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_EQ(solution.reason, "index 1 of dimension 2 has no arc and its singleton is forbidden");
}

TEST(Penalty, GoesOnInTimeAndBounds) {
  double seconds = 0;
  double lower = -kInfinity;
  Options options;
  options.progress = [&](const Progress& now) {
    EXPECT_GE(now.seconds, seconds);
    EXPECT_GE(now.lower_bound, lower - 1e-9);
    seconds = now.seconds;
    lower = now.lower_bound;
    return true;
  };
  const Solution solution = solve(chain(400, true), options);
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_GE(solution.stats.solve_seconds, seconds);
}

}  // namespace
}  // namespace nda
