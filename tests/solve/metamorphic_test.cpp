#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/solve.hpp"
#include "support/random_problems.hpp"
#include "support/rebuilt.hpp"

// What must happen to the optimum when the problem is changed in a way that is understood.  No
// other solver is asked, so the problems may be larger than enumeration could judge.

namespace nda {
namespace {

using core::Random;
using support::rebuilt;
using support::sizes_of;
using support::Tuple;

std::vector<Index> random_permutation(std::size_t n, Random& random) {
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0u);
  core::shuffle(order, random);
  return order;
}

// The optimum; fails unless proven and passed by the checker.
double optimum(const Problem& problem) {
  const Solution solution = solve(problem);
  EXPECT_TRUE(solution.proven) << to_string(solution.status);
  EXPECT_TRUE(check(problem, solution).passed());
  return solution.cost;
}

// Medium problems of all kinds, feasible, with costs of ordinary size.
Problem medium_problem(std::uint64_t seed) {
  Random random(seed);
  support::RandomProblemOptions options;
  options.sizes.resize(3 + random.below(3));
  for (Index& size : options.sizes) size = 4 + static_cast<Index>(random.below(6));
  options.num_arcs = 60 + static_cast<int>(random.below(60));
  options.dummy_share = 0.2 * static_cast<double>(random.below(3));
  options.singletons = static_cast<support::SingletonKind>(random.below(4));
  options.costs = random.below(2) == 0 ? support::CostKind::kInteger : support::CostKind::kDecimal;
  options.sign = static_cast<support::SignKind>(random.below(3));
  options.plant = true;
  return support::random_problem(seed, options);
}

constexpr double kTolerance = 1e-7;

class Metamorphic : public ::testing::Test {
 protected:
  // relation(problem, its optimum, random) for every medium problem.
  template <typename Relation>
  void for_medium_problems(Relation&& relation) {
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
      SCOPED_TRACE(seed);
      const Problem problem = medium_problem(seed);
      Random random(seed);
      relation(problem, optimum(problem), random);
      if (HasFailure()) return;
    }
  }
};

TEST_F(Metamorphic, PermutedDimensionsKeepTheOptimum) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    const std::vector<Index> order = random_permutation(problem.sizes().size(), random);
    const auto permuted = [&](const Tuple& tuple) {
      Tuple moved;
      for (const Index k : order) moved.push_back(tuple[k]);
      return moved;
    };
    const Problem changed = rebuilt(problem,
                                    permuted(sizes_of(problem)),
                                    [&](Tuple& tuple, double&) { tuple = permuted(tuple); });
    EXPECT_NEAR(optimum(changed), cost, kTolerance);
  });
}

TEST_F(Metamorphic, RelabelledIndicesKeepTheOptimum) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    std::vector<std::vector<Index>> label;
    for (const Index size : problem.sizes()) label.push_back(random_permutation(size, random));
    const Problem changed = rebuilt(problem, sizes_of(problem), [&](Tuple& tuple, double&) {
      for (std::size_t k = 0; k < tuple.size(); ++k) {
        if (tuple[k] != 0) tuple[k] = label[k][tuple[k] - 1] + 1;
      }
    });
    EXPECT_NEAR(optimum(changed), cost, kTolerance);
  });
}

TEST_F(Metamorphic, ScaledCostsScaleTheOptimum) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    const double scale = std::pow(10.0, random.uniform(-9, 9));
    const Problem changed =
        rebuilt(problem, sizes_of(problem), [&](Tuple&, double& c) { c *= scale; });
    EXPECT_NEAR(optimum(changed), cost * scale, kTolerance * scale);
  });
}

TEST_F(Metamorphic, AConstantOnOneIndexMovesTheOptimumByIt) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    const std::size_t k = random.below(problem.sizes().size());
    const Index i = 1 + static_cast<Index>(random.below(problem.sizes()[k]));
    const double constant = random.uniform(-30, 30);
    const Problem changed = rebuilt(problem, sizes_of(problem), [&](Tuple& tuple, double& c) {
      if (tuple[k] == i) c += constant;
    });
    EXPECT_NEAR(optimum(changed), cost + constant, kTolerance);
  });
}

TEST_F(Metamorphic, MergedProblemsAddTheirOptima) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomProblemOptions options;
    options.sizes = {5, 6, 4, 5};
    options.num_arcs = 70;
    options.singletons = support::SingletonKind::kMixed;
    options.sign = support::SignKind::kMixed;
    options.plant = true;
    const Problem one = support::random_problem(2 * seed, options);
    const Problem two = support::random_problem(2 * seed + 1, options);
    ProblemBuilder builder({10, 12, 8, 10});
    for (const Problem* problem : {&one, &two}) {
      const Problem moved = rebuilt(*problem, {10, 12, 8, 10}, [&](Tuple& tuple, double&) {
        for (std::size_t k = 0; k < tuple.size(); ++k) {
          if (tuple[k] != 0 && problem == &two) tuple[k] += two.sizes()[k];
        }
      });
      for (std::size_t a = 0; a < moved.num_arcs(); ++a) {
        builder.add_arc(moved.arc(a), moved.costs()[a]);
      }
      for (int k = 0; k < 4; ++k) {
        for (Index i = 1; i <= problem->size(k); ++i) {
          Tuple tuple(4, 0);
          tuple[static_cast<std::size_t>(k)] = i + (problem == &two ? two.size(k) : 0);
          builder.add_arc(tuple, problem->singleton_costs(k)[i]);
        }
      }
    }
    EXPECT_NEAR(optimum(std::move(builder).build()), optimum(one) + optimum(two), kTolerance);
  }
}

TEST_F(Metamorphic, AnEmptyDimensionChangesNothing) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    const auto place = static_cast<std::ptrdiff_t>(random.below(problem.sizes().size() + 1));
    std::vector<Index> sizes = sizes_of(problem);
    sizes.insert(sizes.begin() + place, 0);
    const Problem changed = rebuilt(
        problem, sizes, [&](Tuple& tuple, double&) { tuple.insert(tuple.begin() + place, 0); });
    EXPECT_NEAR(optimum(changed), cost, kTolerance);
  });
}

TEST_F(Metamorphic, ADearerCopyOfAnArcChangesNothing) {
  for_medium_problems([](const Problem& problem, double cost, Random& random) {
    ProblemBuilder builder(sizes_of(problem));
    const Problem same = rebuilt(problem, sizes_of(problem), [](Tuple&, double&) {});
    const auto add_all = [&](double extra) {
      for (std::size_t a = 0; a < same.num_arcs(); ++a) {
        builder.add_arc(same.arc(a), same.costs()[a] + extra);
      }
    };
    add_all(random.uniform(0, 5));
    add_all(0);
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        Tuple tuple(problem.sizes().size(), 0);
        tuple[static_cast<std::size_t>(k)] = i;
        builder.add_arc(tuple, problem.singleton_costs(k)[i]);
      }
    }
    EXPECT_NEAR(optimum(std::move(builder).build()), cost, kTolerance);
  });
}

TEST_F(Metamorphic, WithoutAnArcOfTheSolutionItIsNoCheaper) {
  for_medium_problems([](const Problem& problem, double cost, Random&) {
    const std::vector<Tuple> arcs = solve(problem).solutions.at(0).arcs;
    if (arcs.empty()) return;
    const Problem changed = rebuilt(problem, sizes_of(problem), [&](Tuple& tuple, double& c) {
      if (tuple == arcs.front()) c = kInfinity;
    });
    EXPECT_GE(solve(changed).cost, cost - kTolerance);
  });
}

}  // namespace
}  // namespace nda
