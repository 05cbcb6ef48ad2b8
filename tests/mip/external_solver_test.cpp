#include "mip/external_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mip_support.hpp"
#include "support/brute_force.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

// The real programs, each where it is installed.

namespace nda::mip {
namespace {

using support::CostKind;
using support::IsFeasibleFor;
using support::random_problem;
using support::RandomProblemOptions;
using support::SignKind;
using support::SingletonKind;

class RealSolver : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    surroundings_ = {real_path(), scratch_.path()};
    for (const ExternalKind& kind : external_kinds()) {
      if (kind.name != GetParam()) continue;
      solver_ = kind.find(surroundings_);
      if (!solver_) GTEST_SKIP() << kind.name << " is not installed: " << kind.package;
    }
  }

  void expect_solves(const Problem& problem, const std::optional<double>& optimum) const {
    const ExternalAnswer answer = solver_->solve(problem, limits_);
    EXPECT_GT(answer.seconds, 0);
    EXPECT_EQ(answer.note, "");
    if (!optimum) {
      EXPECT_STREQ(to_string(answer.status), "infeasible");
      EXPECT_EQ(answer.cost, kInfinity);
      EXPECT_EQ(answer.bound, kInfinity);
      return;
    }
    ASSERT_STREQ(to_string(answer.status), "optimal");
    EXPECT_THAT(answer.arcs, IsFeasibleFor(problem));
    const double tolerance = kExternalTolerance + 1e-9 * std::abs(*optimum);
    EXPECT_NEAR(answer.cost, *optimum, tolerance);
    EXPECT_NEAR(answer.bound, *optimum, 2e-6 * std::max(1.0, std::abs(*optimum)));
  }

  void TearDown() override { EXPECT_TRUE(scratch_.is_empty()); }

  Scratch scratch_;
  Surroundings surroundings_;
  std::unique_ptr<ExternalSolver> solver_;
  ExternalLimits limits_ = {60, 60, {}};
};

TEST_P(RealSolver, AgreesWithTheTinyProblems) {
  for (const auto& make : {support::odd_cycle,
                           support::zero_zero_cell,
                           support::perfect_cube,
                           support::one_forced_index,
                           support::infeasible_by_hall,
                           support::infeasible_by_parity}) {
    const support::TinyProblem tiny = make();
    SCOPED_TRACE(tiny.name);
    expect_solves(tiny.problem, tiny.optimum);
  }
}

TEST_P(RealSolver, AgreesWithBruteForceOnRandomProblems) {
  RandomProblemOptions options;
  options.sizes = {3, 4, 3};
  options.num_arcs = 20;
  options.sign = SignKind::kMixed;
  options.singletons = SingletonKind::kMixed;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    options.costs = seed % 2 == 0 ? CostKind::kInteger : CostKind::kDecimal;
    options.plant = seed % 4 != 0;
    const Problem problem = random_problem(seed, options);
    const auto truth = support::brute_force(problem);
    expect_solves(problem, truth ? std::optional(truth->cost) : std::nullopt);
  }
}

TEST_P(RealSolver, AgreesWithBruteForceOnBoundsOnUses) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const support::RandomCase instance = support::random_bounded_case(seed);
    SCOPED_TRACE(instance.description);
    const auto truth = support::brute_force(instance.problem);
    expect_solves(instance.problem, truth ? std::optional(truth->cost) : std::nullopt);
  }
}

TEST_P(RealSolver, HasNothingToSayOfAnEmptyProblem) {
  const Problem problem = support::empty().problem;
  const ExternalAnswer answer = solver_->solve(problem, limits_);
  if (answer.cost < kInfinity) {
    EXPECT_EQ(answer.cost, 0);
  } else {
    EXPECT_STREQ(to_string(answer.status), "failed");
    EXPECT_NE(answer.note, "");
  }
}

std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for (const ExternalKind& kind : external_kinds()) names.push_back(kind.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All,
                         RealSolver,
                         ::testing::ValuesIn(names_of_kinds()),
                         [](const auto& kind) { return kind.param; });

}  // namespace
}  // namespace nda::mip
