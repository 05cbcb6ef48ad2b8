#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "core/right_solution.hpp"
#include "nda/check.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using core::Random;
using Exact = boost::multiprecision::cpp_rational;
using Multipliers = std::vector<std::vector<double>>;

struct ExactBound {
  Exact value = 0;
  Exact magnitude = 0;  // sum of the absolute values of all numbers that enter

  void add(const Exact& term) { value += term; }
};

// The least of s y + u n with n + y in lo..hi and n, y >= 0: at a corner.
Exact least_cost(UseBounds bounds, double singleton, const Exact& u) {
  std::vector<Exact> corners;
  for (const Index uses : {bounds.lo, bounds.hi}) {
    if (uses == UseBounds::kUnlimited) continue;
    corners.push_back(uses * u);
    if (singleton < kInfinity) corners.push_back(uses * Exact(singleton));
  }
  return *std::min_element(corners.begin(), corners.end());
}

// The formula of the header in rational arithmetic.
ExactBound exact_bound(const Problem& problem, const Multipliers& u) {
  ExactBound bound;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      const Exact multiplier(u[static_cast<std::size_t>(k)][i - 1]);
      const double singleton = problem.singleton_costs(k)[i];
      const Exact least = least_cost(problem.use_bounds(k, i), singleton, multiplier);
      bound.add(least);
      bound.magnitude += abs(multiplier) + abs(least);
      if (singleton < kInfinity) bound.magnitude += abs(Exact(singleton));
    }
  }
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    Exact reduced(problem.costs()[a]);
    bound.magnitude += abs(reduced);
    const std::vector<Index> tuple = problem.arc(a);
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] == 0) continue;
      reduced -= Exact(u[k][tuple[k] - 1]);
      bound.magnitude += abs(Exact(u[k][tuple[k] - 1]));
    }
    if (reduced < 0) bound.add(reduced);
  }
  return bound;
}

// Below the exact value, and by no more than two roundings of a double plus the stated error bound.
void expect_rounded_down(const Problem& problem, const Multipliers& u) {
  const double computed = certificate_bound(problem, u);
  ASSERT_TRUE(std::isfinite(computed));
  const ExactBound exact = exact_bound(problem, u);
  EXPECT_LE(Exact(computed), exact.value);
  const double terms =
      static_cast<double>(problem.num_arcs() * (u.size() + 2) + 3 * problem.num_indices() + 1);
  EXPECT_LE(exact.value - Exact(computed),
            abs(exact.value) * Exact(0x1p-51) + exact.magnitude * Exact(2 * terms * 0x1p-100) +
                3 * Exact(std::numeric_limits<double>::denorm_min()));
}

TEST(CertificateBound, IsTheLpValueForOptimalMultipliers) {
  for (const support::TinyProblem& tiny : support::all_tiny_problems()) {
    SCOPED_TRACE(tiny.name);
    if (!tiny.lp_value) continue;
    EXPECT_DOUBLE_EQ(certificate_bound(tiny.problem, tiny.dual), *tiny.lp_value);
    EXPECT_LE(certificate_bound(tiny.problem, tiny.dual), *tiny.lp_value);
  }
}

TEST(CertificateBound, IsNeverAboveTheExactValue) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-13, 12));
    expect_rounded_down(random_case.problem,
                        core::random_multipliers(random_case.problem, random, size));
  }
}

TEST(CertificateBound, IsNeverAboveTheExactValueWithBoundsOnUses) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase random_case = support::random_bounded_case(seed);
    const Problem& problem = random_case.problem;
    SCOPED_TRACE(random_case.description);
    Random random(seed);
    Multipliers u = core::random_multipliers(problem, random, 1);
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        double& multiplier = u[static_cast<std::size_t>(k)][i - 1];
        multiplier *= std::pow(10.0, random.uniform(-13, 12));
        if (problem.use_bounds(k, i).hi == UseBounds::kUnlimited) multiplier = std::abs(multiplier);
      }
    }
    expect_rounded_down(problem, u);
  }
}

// Multipliers of all magnitudes side by side: 1e12 next to 1e-12.
TEST(CertificateBound, IsNeverAboveTheExactValueForWildMultipliers) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    Random random(seed);
    Multipliers u = core::random_multipliers(random_case.problem, random, 1);
    for (std::vector<double>& row : u) {
      for (double& multiplier : row) multiplier *= std::pow(10.0, random.uniform(-13, 12));
    }
    expect_rounded_down(random_case.problem, u);
  }
}

// Reduced costs of exactly or nearly 0, where a wrong sign would count or forget an arc.
TEST(CertificateBound, IsNeverAboveTheExactValueForTightMultipliers) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const support::RandomCase random_case = support::random_case(seed);
    SCOPED_TRACE(random_case.description);
    const Problem& problem = random_case.problem;
    Random random(seed);
    Multipliers u = core::random_multipliers(problem, random, 1);
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      const std::vector<Index> tuple = problem.arc(a);
      double rest = problem.costs()[a];
      double* last = nullptr;
      for (std::size_t k = 0; k < tuple.size(); ++k) {
        if (tuple[k] == 0) continue;
        last = &u[k][tuple[k] - 1];
        rest -= *last;
      }
      *last += rest;
    }
    expect_rounded_down(problem, u);
  }
}

TEST(CertificateBound, OfNothingIsZero) {
  EXPECT_EQ(certificate_bound(support::empty().problem, {{}, {}, {}}), 0);
  const Problem problem = support::make_problem({1, 1}, {{{1, 1}, 3}});
  EXPECT_EQ(certificate_bound(problem, {{0}, {0}}), 0) << "nothing was rounded";
}

// Costs so small that the bound on the rounding errors underflows.
TEST(CertificateBound, IsNeverAboveTheExactValueForTinyCosts) {
  for (const double cost : {-1e-300, -1e-320, -std::numeric_limits<double>::denorm_min()}) {
    SCOPED_TRACE(cost);
    const Problem problem = support::make_problem({1, 1}, {{{1, 1}, cost}});
    EXPECT_LE(certificate_bound(problem, {{0}, {0}}), cost);
    expect_rounded_down(problem, {{0}, {0}});
    expect_rounded_down(problem, {{cost}, {0}});
  }
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = std::pow(10.0, random.uniform(-323, -290));
    ProblemBuilder builder({3, 3, 3});
    for (Index a = 0; a < 9; ++a) {
      builder.add_arc({1 + a / 3, 1 + a % 3, static_cast<Index>(random.below(4))},
                      random.uniform(-9, 3) * size);
    }
    const Problem problem = std::move(builder).build();
    expect_rounded_down(problem, core::random_multipliers(problem, random, size));
  }
}

TEST(CertificateBound, NamesMultipliersThatDoNotFit) {
  const Problem problem = support::make_problem({1, 2}, {{{1, 1}, 3}});
  const auto message = [&](const Multipliers& u) -> std::string {
    try {
      certificate_bound(problem, u);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message({{0}}), "multipliers of 1 dimensions, the problem has 2");
  EXPECT_EQ(message({{0}, {0, 0}, {0}}), "multipliers of 3 dimensions, the problem has 2");
  EXPECT_EQ(message({{0}, {0}}), "dimension 2 has 1 multipliers, not 2");
  EXPECT_EQ(message({{0, 0}, {0, 0}}), "dimension 1 has 2 multipliers, not 1");
  EXPECT_EQ(message({{0}, {0, kInfinity}}), "a multiplier of dimension 2 is not finite");
}

TEST(CertificateBound, IgnoresForbiddenSingletons) {
  const Problem problem = support::make_problem({1, 1}, {{{1, 1}, 3}}, kInfinity);
  EXPECT_DOUBLE_EQ(certificate_bound(problem, {{2}, {1}}), 3);
  EXPECT_DOUBLE_EQ(certificate_bound(problem, {{1e6}, {0}}), 3);
}

// Costs and multipliers near the largest double: sums overflow, and what cannot be computed must
// not be claimed.
TEST(CertificateBound, ClaimsNothingWhereSumsOverflow) {
  const Problem problem = support::make_problem({1, 1}, {{{1, 1}, -1e308}, {{1, 0}, kInfinity}}, 0);
  EXPECT_LE(certificate_bound(problem, {{1.7e308}, {-1e308}}), -1e308);
  const Problem wide = support::make_problem({2, 1}, {{{1, 1}, 1}}, kInfinity);
  EXPECT_EQ(certificate_bound(wide, {{1.7e308, 1.7e308}, {-1.7e308}}), -kInfinity);
}

}  // namespace
}  // namespace nda
