#include <gtest/gtest.h>

#include "nda/solve.hpp"
#include "solve/many_to_one.hpp"
#include "support/many_to_one_problems.hpp"

namespace nda {
namespace {

// The first try of the rest ends at its share of the time, as if it were long.
TEST(ManyToOneTime, IsGivenToTheRestWhereItIsLeft) {
  int num_tried_again = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = support::random_bounded_problem(seed, {});
    const Solution whole = solve(problem);
    if (whole.status != Status::kOptimal) continue;
    int num_tries = 0;
    const auto solve_once =
        [&](const Problem& rest, const Options& options, const WarmStart& warm) {
          Solution solution = solve(rest, options, warm);
          if (++num_tries > 1) return solution;
          solution.proven = false;
          solution.status = Status::kTimeLimit;
          return solution;
        };
    const Solution found = pipeline::solve_many_to_one(problem, {}, {}, solve_once);
    EXPECT_STREQ(to_string(found.status), "optimal");
    EXPECT_TRUE(found.proven);
    EXPECT_NEAR(found.cost, whole.cost, 1e-9);
    num_tried_again += num_tries > 1;
  }
  EXPECT_GT(num_tried_again, 10);
}

}  // namespace
}  // namespace nda
