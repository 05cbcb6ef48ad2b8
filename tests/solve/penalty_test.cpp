#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <utility>
#include <vector>

#include "core/shift.hpp"
#include "nda/check.hpp"
#include "nda/proof.hpp"
#include "nda/solve.hpp"
#include "solve/penalties.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

// A cost whose last digit is hidden by penalties that are surely enough.
constexpr double kOne = 1.000000001;

// Chains of arcs (i, i, i) that cost kOne and (i, i + 1, i) that gain it: the only solution takes
// the former.  Leaving three indices of a chain uncovered saves nearly 2 n, more than a modest
// penalty for each where n is large.
class Chains {
 public:
  explicit Chains(std::vector<Index> lengths) : lengths_(std::move(lengths)) {}

  // Without the first arc of the last chain if it is `open`: then index `first` of dimension 2 of
  // it has no arc.
  Problem build(bool open = false) const {
    const auto total = std::accumulate(lengths_.begin(), lengths_.end(), Index{0});
    ProblemBuilder builder({total, total, total});
    Index first = 1;
    for (std::size_t chain = 0; chain < lengths_.size(); ++chain) {
      const Index end = first + lengths_[chain];
      for (Index i = first; i < end; ++i) {
        const bool is_missing = open && chain + 1 == lengths_.size() && i == first;
        if (!is_missing) builder.add_arc({i, i, i}, kOne);
        if (i + 1 < end) builder.add_arc({i, i + 1, i}, -kOne);
        builder.add_arc({i, 0, 0}, kInfinity);
        builder.add_arc({0, i, 0}, kInfinity);
        builder.add_arc({0, 0, i}, kInfinity);
      }
      first = end;
    }
    return std::move(builder).build();
  }

 private:
  std::vector<Index> lengths_;
};

bool is_modest(const Problem& problem) {
  return pipeline::hides_digits(problem, core::make_shift(problem), core::find_grid(problem));
}

double optimum(const Problem& problem) {
  return problem.size(0) * kOne;
}

TEST(Penalty, IsRaisedWhereTheModestOneIsNotEnough) {
  for (const std::vector<Index>& lengths :
       {std::vector<Index>{400}, {3, 50, 400}, {100, 100, 100, 100}}) {
    const Problem problem = Chains(lengths).build();
    ASSERT_TRUE(is_modest(problem));
    const Solution solution = solve(problem);
    EXPECT_EQ(solution.status, Status::kOptimal) << lengths.size();
    EXPECT_NEAR(solution.cost, optimum(problem), 1e-9 * optimum(problem));
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

TEST(Penalty, TooLowProvesNothingInfeasible) {
  Options options;
  options.progress = [](const Progress& now) { return now.components_done == 0; };
  const Problem problem = Chains({400, 300}).build();
  const Solution stopped = solve(problem, options);
  EXPECT_EQ(stopped.status, Status::kInterrupted);
  for (const ComponentReport& component : stopped.components)
    EXPECT_NE(component.status, Status::kInfeasible);
  EXPECT_LE(stopped.lower_bound, optimum(problem) + 1e-6);
  EXPECT_THAT(check(problem, stopped).faults, IsEmpty());
  const Solution infeasible = solve(Chains({300, 300}).build(true));
  EXPECT_EQ(infeasible.status, Status::kInfeasible);
  EXPECT_EQ(infeasible.reason,
            "index 301 of dimension 2 has no arc and its singleton is forbidden");
}

TEST(Penalty, GoesOnInTimeBoundsAndComponents) {
  Progress last;
  Options options;
  options.progress = [&](const Progress& now) {
    EXPECT_GE(now.seconds, last.seconds);
    EXPECT_GE(now.lower_bound, last.lower_bound - 1e-9);
    EXPECT_GE(now.components_done, last.components_done);
    last = now;
    return true;
  };
  const Solution solution = solve(Chains(std::vector<Index>(50, 100)).build(), options);
  EXPECT_EQ(solution.status, Status::kOptimal);
  EXPECT_GE(solution.stats.solve_seconds, last.seconds);
  EXPECT_GE(solution.lower_bound, last.lower_bound - 1e-6);
}

// Stopped anywhere, the answer is honest.
TEST(Penalty, MayBeStoppedAtAnyTime) {
  int num_stopped = 0;
  const Problem problem = Chains({200, 60, 400, 5}).build();
  for (int calls = 1; calls < 40; ++calls) {
    int left = calls;
    Options options;
    options.progress = [&](const Progress&) { return --left > 0; };
    const Solution solution = solve(problem, options);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty()) << calls;
    EXPECT_NE(solution.status, Status::kInfeasible);
    EXPECT_LE(solution.lower_bound, optimum(problem) + 1e-6);
    num_stopped += solution.status == Status::kInterrupted;
    if (solution.status == Status::kOptimal) break;
  }
  EXPECT_GT(num_stopped, 10);
}

TEST(Penalty, LeavesProofsWhole) {
  Options options;
  options.proof = true;
  const Problem problem = Chains({30, 400}).build();
  const Solution solution = solve(problem, options);
  ASSERT_TRUE(solution.proof.has_value());
  const ProofReport report = check_proof(problem, *solution.proof);
  EXPECT_EQ(report.fault, "");
  EXPECT_NEAR(report.lower_bound, optimum(problem), 1e-6);
}

}  // namespace
}  // namespace nda
