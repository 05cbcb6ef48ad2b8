#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"

// Random sequences of calls: build, solve with random options, check, interrupt, solve again.  All
// answers about one problem must agree with each other: no bound above any cost, proven costs
// equal.

namespace nda {
namespace {

using core::Random;

Options random_options(Random& random) {
  Options options;
  options.method = static_cast<Method>(random.below(3));
  options.num_threads = static_cast<int>(random.below(3));
  options.seed = random();
  options.relaxation.dual_method = static_cast<DualMethod>(random.below(3));
  options.relaxation.assign2d = static_cast<Assign2dMethod>(random.below(3));
  options.relaxation.max_evaluations = 1 + static_cast<int>(random.below(40));
  options.relaxation.recovery_evaluations = 1 + static_cast<int>(random.below(10));
  options.relaxation.recovery_interval = 1 + static_cast<int>(random.below(12));
  options.search.local_search = random.below(2) == 0;
  options.search.kicks_per_index = static_cast<int>(random.below(60));
  options.branch.exact_arcs = random.below(2) == 0 ? 0 : 60;
  options.branch.node_evaluations = 1 + static_cast<int>(random.below(60));
  if (random.below(4) == 0) {
    options.branch.max_nodes = static_cast<std::int64_t>(random.below(10));
  }
  if (random.below(4) == 0) options.relative_gap = random.uniform(0, 0.5);
  if (random.below(4) == 0) options.time_limit_s = random.uniform(1e-9, 1e-3);
  if (random.below(4) == 0) {
    options.progress = [calls = 1 + random.below(5)](const Progress&) mutable {
      return --calls > 0;
    };
  }
  return options;
}

// Size of the terms of any solution: what rounding is relative to.
double magnitude(const Problem& problem) {
  double largest = 0;
  const auto note = [&](double cost) {
    if (cost < kInfinity) largest = std::max(largest, std::abs(cost));
  };
  for (const double cost : problem.costs()) note(cost);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) note(cost);
  }
  return largest * static_cast<double>(problem.num_indices());
}

// What is known of one problem after a few solves.
class Record {
 public:
  explicit Record(const Problem& problem)
      : problem_(problem),
        tolerance_(1e-14 * magnitude(problem)),
        best_(support::brute_force(problem)) {}

  void add(const Solution& solution) {
    const CheckReport report = check(problem_, solution);
    EXPECT_THAT(report.faults, ::testing::IsEmpty());
    if (!best_) {
      EXPECT_THAT(solution.solutions, ::testing::IsEmpty());
      return;
    }
    EXPECT_NE(solution.status, Status::kInfeasible);
    const double slack = tolerance_ + 1e-9 * std::abs(best_->cost);
    EXPECT_LE(solution.lower_bound, best_->cost + slack);
    EXPECT_GE(solution.cost, best_->cost - slack);
    if (solution.proven) {
      EXPECT_NEAR(solution.cost, best_->cost, slack);
    }
  }

 private:
  const Problem& problem_;
  const double tolerance_;
  const std::optional<support::ExactSolution> best_;
};

// The same problem, its arcs added in another order and some of them twice.
Problem rebuilt(const Problem& problem, Random& random) {
  ProblemBuilder builder({problem.sizes().begin(), problem.sizes().end()});
  for (std::size_t a = problem.num_arcs(); a-- > 0;) {
    builder.add_arc(problem.arc(a), problem.costs()[a]);
    if (random.below(3) == 0) builder.add_arc(problem.arc(a), problem.costs()[a]);
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      std::vector<Index> tuple(problem.sizes().size(), 0);
      tuple[static_cast<std::size_t>(k)] = i;
      builder.add_arc(tuple, problem.singleton_costs(k)[i]);
    }
  }
  return std::move(builder).build();
}

TEST(Sequences, OfRandomCallsAgreeWithEachOther) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    support::RandomCase random_case = support::random_case(seed + 50000);
    SCOPED_TRACE(random_case.description);
    Random random(seed);
    Problem problem = std::move(random_case.problem);
    Record record(problem);
    for (int call = 0; call < 6; ++call) {
      SCOPED_TRACE(call);
      switch (random.below(5)) {
        case 0:
          problem = rebuilt(problem, random);
          break;
        case 1: {
          Options wrong;
          wrong.relative_gap = -1;
          EXPECT_THROW(solve(problem, wrong), InputError);
          break;
        }
        default:
          record.add(solve(problem, random_options(random)));
      }
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace nda
