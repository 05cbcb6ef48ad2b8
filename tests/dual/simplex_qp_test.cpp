#include "dual/simplex_qp.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "core/random.hpp"
#include "dual/nlopt_simplex_qp.hpp"

namespace nda::dual {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

/// A program that owns its data: G = V'V for the columns of V.
struct Program {
  std::vector<double> gram;
  std::vector<double> linear;

  SimplexQpProblem view() const { return {linear.size(), gram, linear.size(), linear}; }
  std::size_t size() const { return linear.size(); }
};

Program from_columns(const std::vector<std::vector<double>>& columns, std::vector<double> linear) {
  Program p;
  p.linear = std::move(linear);
  for (const auto& a : columns) {
    for (const auto& b : columns) {
      p.gram.push_back(std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
    }
  }
  return p;
}

/// n columns of `rank` entries, some of them repeated; integer entries when `integer`.
Program random_program(std::size_t n, std::size_t rank, bool integer, core::Random& random) {
  std::vector<std::vector<double>> columns;
  std::vector<double> linear;
  for (std::size_t i = 0; i < n; ++i) {
    if (i > 0 && random.below(4) == 0) {
      const auto copy = static_cast<std::size_t>(random.below(i));
      columns.push_back(columns[copy]);
      linear.push_back(random.below(2) == 0 ? linear[copy] : random.uniform(0, 2));
      continue;
    }
    std::vector<double> column(rank);
    for (double& x : column) {
      x = integer ? static_cast<double>(random.below(5)) - 2 : random.uniform(-1, 1);
    }
    columns.push_back(column);
    linear.push_back(integer ? static_cast<double>(random.below(3)) : random.uniform(0, 1));
  }
  return from_columns(columns, linear);
}

double objective(const Program& p, const std::vector<double>& l) {
  double value = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    value += p.linear[i] * l[i];
    for (std::size_t j = 0; j < p.size(); ++j) value += l[i] * l[j] * p.gram[i * p.size() + j] / 2;
  }
  return value;
}

/// Largest violation of the conditions of Karush, Kuhn and Tucker, relative to the data.
double kkt_violation(const Program& p, const std::vector<double>& l) {
  double scale = 1e-300;
  for (std::size_t i = 0; i < p.size(); ++i) {
    scale = std::max({scale, p.gram[i * p.size() + i], std::abs(p.linear[i])});
  }
  std::vector<double> gradient = p.linear;
  double multiplier = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < p.size(); ++j) gradient[i] += p.gram[i * p.size() + j] * l[j];
    multiplier += l[i] * gradient[i];
  }
  double worst = std::abs(std::accumulate(l.begin(), l.end(), -1.0));
  for (std::size_t i = 0; i < p.size(); ++i) {
    worst = std::max(worst, -l[i]);
    worst = std::max(worst, (multiplier - gradient[i]) / scale);
    worst = std::max(worst, l[i] * std::abs(gradient[i] - multiplier) / scale);
  }
  return worst;
}

template <class Solver>
class SimplexQpTest : public ::testing::Test {
 protected:
  std::vector<double> solve(const Program& p, std::vector<double> guess = {}) {
    guess.resize(p.size(), 0.0);
    result_ = solver_.solve(p.view(), guess);
    return guess;
  }
  Solver solver_;
  SimplexQpResult result_;
};

using Solvers = ::testing::Types<ActiveSetQp, NloptSimplexQp>;
TYPED_TEST_SUITE(SimplexQpTest, Solvers);

TYPED_TEST(SimplexQpTest, GivesAllWeightToTheOnlySubgradient) {
  EXPECT_THAT(this->solve(from_columns({{3, 4}}, {7})), Pointwise(DoubleNear(1e-12), {1.0}));
  EXPECT_NEAR(this->result_.multiplier, 25 + 7, 1e-12);
}

// min 1/2 (l1 - l2)^2 + l2 / 2 on the simplex: with l1 = 1 - l2 the derivative is -2 + 4 l2 + 1/2.
TYPED_TEST(SimplexQpTest, BalancesTwoOpposedSubgradients) {
  EXPECT_THAT(this->solve(from_columns({{1}, {-1}}, {0, 0.5})),
              Pointwise(DoubleNear(1e-6), {0.625, 0.375}));
  EXPECT_NEAR(this->result_.multiplier, 0.25, 1e-6);
}

// The point of the triangle (2, 0), (0, 2), (3, 3) nearest to 0 is (1, 1).
TYPED_TEST(SimplexQpTest, FindsTheNearestPointOfATriangle) {
  EXPECT_THAT(this->solve(from_columns({{2, 0}, {0, 2}, {3, 3}}, {0, 0, 0})),
              Pointwise(DoubleNear(1e-6), {0.5, 0.5, 0.0}));
}

TYPED_TEST(SimplexQpTest, SolvesALinearProgramWhenAllSubgradientsAreZero) {
  EXPECT_THAT(this->solve(from_columns({{0}, {0}, {0}}, {2, 1, 3})),
              Pointwise(DoubleNear(1e-6), {0.0, 1.0, 0.0}));
}

TYPED_TEST(SimplexQpTest, PrefersTheCheaperOfTwoEqualSubgradients) {
  EXPECT_THAT(this->solve(from_columns({{1, 2}, {1, 2}}, {0.5, 0.25}), {0.5, 0.5}),
              Pointwise(DoubleNear(1e-6), {0.0, 1.0}));
}

TYPED_TEST(SimplexQpTest, SatisfiesTheOptimalityConditionsOnSmallRandomPrograms) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const auto n = static_cast<std::size_t>(1 + random.below(8));
    const Program p =
        random_program(n, static_cast<std::size_t>(1 + random.below(6)), seed % 2 == 0, random);
    EXPECT_LE(kkt_violation(p, this->solve(p)), 2e-6);
  }
}

TEST(ActiveSetQp, SatisfiesTheOptimalityConditionsToRoundingOnSingularPrograms) {
  ActiveSetQp solver;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const auto n = static_cast<std::size_t>(1 + random.below(50));
    const auto rank = static_cast<std::size_t>(1 + random.below(40));
    const Program p = random_program(n, rank, seed % 2 == 0, random);
    std::vector<double> weights(n, seed % 3 == 0 ? 1.0 : 0.0);
    EXPECT_TRUE(solver.solve(p.view(), weights).converged);
    EXPECT_LE(kkt_violation(p, weights), 1e-11);
  }
}

TEST(ActiveSetQp, IsNeverWorseThanSlsqp) {
  ActiveSetQp own;
  NloptSimplexQp reference;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Program p =
        random_program(1 + static_cast<std::size_t>(random.below(20)), 5, false, random);
    std::vector<double> ours(p.size(), 0.0);
    std::vector<double> theirs(p.size(), 0.0);
    own.solve(p.view(), ours);
    reference.solve(p.view(), theirs);
    EXPECT_LE(objective(p, ours), objective(p, theirs) + 1e-12);
    EXPECT_NEAR(objective(p, ours), objective(p, theirs), 1e-5);
  }
}

TEST(ActiveSetQp, NeedsNoChangeWhenStartedFromTheSolution) {
  ActiveSetQp solver;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const Program p = random_program(30, 12, false, random);
    std::vector<double> weights(p.size(), 0.0);
    solver.solve(p.view(), weights);
    const std::vector<double> first = weights;
    EXPECT_EQ(solver.solve(p.view(), weights).iterations, 0);
    EXPECT_THAT(weights, Pointwise(DoubleNear(1e-9), first));
  }
}

TEST(ActiveSetQp, SolvesDataOfEveryScale) {
  ActiveSetQp solver;
  for (const double scale : {1e-24, 1e-9, 1e6, 1e24}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(scale);
      SCOPED_TRACE(seed);
      core::Random random(seed);
      Program p = random_program(25, 6, seed % 2 == 0, random);
      for (double& x : p.gram) x *= scale;
      for (double& x : p.linear) x *= scale;
      std::vector<double> weights(p.size(), 0.0);
      EXPECT_TRUE(solver.solve(p.view(), weights).converged);
      EXPECT_LE(kkt_violation(p, weights), 1e-11);
    }
  }
}

// A proximal step that hardly matters (a large against G) or that is all there is (a tiny).
TEST(ActiveSetQp, SolvesDataWhoseTermsDifferByManyOrders) {
  ActiveSetQp solver;
  for (const double scale : {1e-12, 1e-6, 1e6, 1e12}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      SCOPED_TRACE(scale);
      SCOPED_TRACE(seed);
      core::Random random(seed);
      Program p = random_program(25, 6, false, random);
      for (double& x : p.linear) x *= scale;
      std::vector<double> weights(p.size(), 0.0);
      EXPECT_TRUE(solver.solve(p.view(), weights).converged);
      EXPECT_LE(kkt_violation(p, weights), 1e-11);
    }
  }
}

TEST(ActiveSetQp, SurvivesSubgradientsThatDifferInTheLastDigits) {
  ActiveSetQp solver;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    std::vector<std::vector<double>> columns;
    std::vector<double> linear;
    for (int i = 0; i < 20; ++i) {
      std::vector<double> column(6);
      for (std::size_t k = 0; k < column.size(); ++k) {
        const double base =
            i < 4 ? random.uniform(-1, 1) : columns[static_cast<std::size_t>(i % 4)][k];
        column[k] = base + 1e-9 * random.uniform(-1, 1);
      }
      columns.push_back(column);
      linear.push_back(1e-9 * random.uniform());
    }
    const Program p = from_columns(columns, linear);
    std::vector<double> weights(p.size(), 0.0);
    solver.solve(p.view(), weights);
    EXPECT_LE(kkt_violation(p, weights), 1e-11);
  }
}

// A bundle near the maximum: neighbouring planes of a smooth piece, and a steep one from the start
// of the run that has no part in the solution but must not set the precision.
TEST(ActiveSetQp, ResolvesNeighboursBesideASteepSubgradient) {
  ActiveSetQp solver;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    std::vector<std::vector<double>> columns;
    std::vector<double> linear;
    for (int i = 0; i < 20; ++i) {
      std::vector<double> column(6);
      for (std::size_t k = 0; k < column.size(); ++k) {
        const double base =
            i < 4 ? random.uniform(-1, 1) : columns[static_cast<std::size_t>(i % 4)][k];
        column[k] = base + 1e-3 * random.uniform(-1, 1);
      }
      columns.push_back(column);
      linear.push_back(1e-6 * random.uniform());
    }
    const Program p = from_columns(columns, linear);
    columns.emplace_back(6, 1e5);
    linear.push_back(1e6);
    const Program steep = from_columns(columns, linear);
    std::vector<double> weights(steep.size(), 0.0);
    weights[0] = 1;
    EXPECT_TRUE(solver.solve(steep.view(), weights).converged);
    weights.pop_back();
    EXPECT_LE(kkt_violation(p, weights), 1e-12);
  }
}

// Entries of 0, near the smallest and near the largest number, mixed or all alike, columns
// repeated, guesses good for nothing: the limit of changes holds and the weights are those of a
// point.
TEST(ActiveSetQp, EndsAtAFeasiblePointWhateverTheEntries) {
  constexpr double kSizes[] = {0, 5e-324, 1e-310, 1e-160, 1e-100, 1, 1e100, 1e154, 1e200, 1e308};
  ActiveSetQp solver;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const auto n = static_cast<std::size_t>(1 + random.below(20));
    const auto size = [&, fixed = random.below(11)] {
      return kSizes[fixed < 10 ? fixed : random.below(10)];
    };
    Program p = random_program(n, 1 + static_cast<std::size_t>(random.below(6)), true, random);
    std::vector<double> factors(n);
    for (double& factor : factors) factor = size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) p.gram[i * n + j] *= factors[i] * factors[j];
      p.linear[i] *= size();
    }
    std::vector<double> weights(n);
    for (double& weight : weights) weight = random.below(2) == 0 ? 0 : size();
    const SimplexQpResult result = solver.solve(p.view(), weights);
    EXPECT_LE(result.iterations, 10 * static_cast<int>(n) + 50);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-8);
    for (const double weight : weights) EXPECT_GE(weight, 0);
    if (HasFailure()) return;
  }
}

TEST(ActiveSetQp, SaysThatItDidNotSolveWhatOverflows) {
  const Program p = from_columns({{1e200}, {-1e200}}, {0, 0});
  std::vector<double> weights(2, 0.5);
  EXPECT_FALSE(ActiveSetQp().solve(p.view(), weights).converged);
  EXPECT_EQ(weights[0] + weights[1], 1);
}

TEST(ActiveSetQp, ReadsAMatrixWithAStride) {
  const std::vector<double> gram = {1, -1, 99, -1, 1, 99};
  const std::vector<double> linear = {0, 0.5};
  std::vector<double> weights = {0, 0};
  ActiveSetQp().solve({2, gram, 3, linear}, weights);
  EXPECT_THAT(weights, Pointwise(DoubleNear(1e-12), {0.625, 0.375}));
}

}  // namespace
}  // namespace nda::dual
