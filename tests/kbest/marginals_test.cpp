#include "nda/marginals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "support/brute_force.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pointwise;

using Tuple = std::vector<Index>;
using Place = std::pair<int, Index>;

constexpr std::size_t kMostSolutions = 5000;

// All solutions of a problem, ranked.
Solution rank_all(const Problem& problem) {
  return solve_k_best(problem, kMostSolutions + 1);
}

double weight_of(const Marginals& marginals, const Tuple& arc) {
  for (const ArcMarginal& marginal : marginals.arcs) {
    if (marginal.arc == arc) return marginal.weight;
  }
  return 0;
}

double weight_of(const Marginals& marginals, const Place& first, const Place& second) {
  for (const PairMarginal& pair : marginals.pairs) {
    if (Place(pair.first_dimension, pair.first) == first &&
        Place(pair.second_dimension, pair.second) == second)
      return pair.weight;
  }
  return 0;
}

RankedSolution listed(double cost, std::vector<Tuple> arcs) {
  return {1, cost, true, std::move(arcs)};
}

// The arc of weight w = e^5 / (e^5 + 1) = 0.9933071 against nothing.  Entropy of every index:
// -w ln w - (1 - w) ln(1 - w) = 0.0066704 + 0.0335092 = 0.0401796.
TEST(Marginals, OfOneArcAreLogistic) {
  const Marginals result = marginals(rank_all(support::one_arc().problem));
  EXPECT_THAT(result.weights,
              ElementsAre(DoubleNear(0.9933071, 1e-7), DoubleNear(0.0066929, 1e-7)));
  EXPECT_NEAR(weight_of(result, {1, 1, 1}), 0.9933071, 1e-7);
  EXPECT_NEAR(weight_of(result, {0, 1}, {2, 1}), 0.9933071, 1e-7);
  EXPECT_NEAR(result.alone[1][0], 0.0066929, 1e-7);
  ASSERT_EQ(result.ambiguous.size(), 3u);
  EXPECT_NEAR(result.ambiguous[0].entropy, 0.0401796, 1e-7);
}

// Two targets in three scans, support::crossing_tracks().  Seven solutions: both parallel tracks
// e^8 = 2980.958, both crossing ones e^7 = 1096.633, one alone e^5 = 148.413, twice e^4 = 54.598,
// e^2 = 7.389, none 1; together 4343.589.
//   arc (1,1,1)  (e^8 + e^4) / 4343.589 = 0.6988588,   arc (1,1,2)  (e^7 + e^5) / ... = 0.2866399
//   pair of 1 in dimension 1 and 1 in dimension 2: both arcs = 0.9854987
//   2 of dimension 1 alone: (e^5 + e^4 + 1) / ... = 0.0469684
TEST(Marginals, OfCrossingTracksAreThoseOfTheComment) {
  const Marginals result = marginals(rank_all(support::crossing_tracks().problem));
  EXPECT_EQ(result.weights.size(), 7u);
  EXPECT_EQ(result.num_proven, 7u);
  EXPECT_NEAR(weight_of(result, {1, 1, 1}), 0.6988588, 1e-6);
  EXPECT_NEAR(weight_of(result, {1, 1, 2}), 0.2866399, 1e-6);
  EXPECT_NEAR(weight_of(result, {0, 1}, {1, 1}), 0.9854987, 1e-6);
  EXPECT_NEAR(result.alone[0][1], 0.0469684, 1e-6);
  EXPECT_EQ(result.ambiguous.size(), 6u);
}

// What brute force says of a problem: exact posteriors.
struct Posterior {
  std::map<Tuple, long double> arcs;
  std::map<std::pair<Place, Place>, long double> pairs;
  std::map<Place, long double> covered;
};

Posterior posterior(const std::vector<support::ExactSolution>& all, double cost_per_nat) {
  Posterior result;
  long double sum = 0;
  const auto weight = [&](const support::ExactSolution& solution) {
    return std::exp((static_cast<long double>(all.front().cost) - solution.cost) / cost_per_nat);
  };
  for (const support::ExactSolution& solution : all) sum += weight(solution);
  for (const support::ExactSolution& solution : all) {
    for (const Tuple& arc : solution.arcs) {
      result.arcs[arc] += weight(solution) / sum;
      for (int k = 0; k < static_cast<int>(arc.size()); ++k) {
        const Index i = arc[static_cast<std::size_t>(k)];
        if (i == 0) continue;
        result.covered[{k, i}] += weight(solution) / sum;
        for (int other = k + 1; other < static_cast<int>(arc.size()); ++other) {
          const Index j = arc[static_cast<std::size_t>(other)];
          if (j != 0) result.pairs[{{k, i}, {other, j}}] += weight(solution) / sum;
        }
      }
    }
  }
  return result;
}

void expect_posterior(const Marginals& actual, const Posterior& expected) {
  ASSERT_EQ(actual.arcs.size(), expected.arcs.size());
  for (const ArcMarginal& arc : actual.arcs)
    EXPECT_NEAR(arc.weight, static_cast<double>(expected.arcs.at(arc.arc)), 1e-9);
  ASSERT_EQ(actual.pairs.size(), expected.pairs.size());
  for (const PairMarginal& pair : actual.pairs) {
    const Place first = {pair.first_dimension, pair.first};
    const Place second = {pair.second_dimension, pair.second};
    EXPECT_NEAR(pair.weight, static_cast<double>(expected.pairs.at({first, second})), 1e-9);
  }
  for (int k = 0; k < static_cast<int>(actual.alone.size()); ++k) {
    const std::vector<double>& alone = actual.alone[static_cast<std::size_t>(k)];
    for (Index i = 1; i <= alone.size(); ++i) {
      const auto covered = expected.covered.find({k, i});
      const long double share = covered == expected.covered.end() ? 0 : covered->second;
      EXPECT_NEAR(alone[i - 1], static_cast<double>(1 - share), 1e-9);
    }
  }
}

// Of every index, and of the ranks.
void expect_sums_of_one(const Marginals& marginals) {
  std::vector<std::vector<double>> sums = marginals.alone;
  for (const ArcMarginal& arc : marginals.arcs) {
    for (std::size_t k = 0; k < arc.arc.size(); ++k) {
      if (arc.arc[k] != 0) sums[k][arc.arc[k] - 1] += arc.weight;
    }
  }
  for (const std::vector<double>& row : sums) {
    for (const double sum : row) EXPECT_NEAR(sum, 1, 1e-12);
  }
  double sum = 0;
  for (const double weight : marginals.weights) sum += weight;
  EXPECT_NEAR(sum, 1, 1e-12);
}

// A tenth of the largest finite cost, so that weights are neither all alike nor all 0.
double fitting_unit(const Problem& problem) {
  double largest = 0;
  for (const double cost : problem.costs()) largest = std::max(largest, std::abs(cost));
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (std::isfinite(cost)) largest = std::max(largest, std::abs(cost));
    }
  }
  return largest > 0 ? largest / 10 : 1;
}

// k = all: the weights are exact posteriors.  nda::check() computes them a third time.
TEST(Marginals, OfAllSolutionsAreThePosterior) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    std::vector<support::ExactSolution> all;
    try {
      all = support::all_solutions(random.problem, kMostSolutions);
    } catch (const std::length_error&) {
      continue;
    }
    Solution solution = solve_k_best(random.problem, all.size() + 1);
    if (all.empty() || solution.status == Status::kPrecisionLost) continue;
    const double cost_per_nat = fitting_unit(random.problem);
    solution.marginals = marginals(solution, {cost_per_nat});
    expect_posterior(*solution.marginals, posterior(all, cost_per_nat));
    expect_sums_of_one(*solution.marginals);
    EXPECT_THAT(check(random.problem, solution).faults, IsEmpty());
    ++compared;
    if (HasFailure()) break;
  }
  EXPECT_GT(compared, 800);
}

// A charge for every use of an index, its singleton included, is in every solution.
TEST(Marginals, IgnoreWhatEverySolutionPays) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = support::random_problem(seed);
    core::Random random(seed);
    std::vector<std::vector<double>> charges;
    ProblemBuilder builder({3, 3, 3});
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<double>& row = charges.emplace_back(4, 0.0);
      for (Index i = 1; i <= 3; ++i) {
        row[i] = std::floor(random.uniform(-50, 50));
        Tuple singleton(3, 0);
        singleton[k] = i;
        builder.add_arc(singleton, problem.singleton_costs(static_cast<int>(k))[i] + row[i]);
      }
    }
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      const Tuple arc = problem.arc(a);
      builder.add_arc(
          arc, problem.costs()[a] + charges[0][arc[0]] + charges[1][arc[1]] + charges[2][arc[2]]);
    }
    const Marginals plain = marginals(rank_all(problem));
    const Marginals charged = marginals(rank_all(std::move(builder).build()));
    EXPECT_THAT(charged.weights, Pointwise(DoubleNear(1e-9), plain.weights));
    ASSERT_EQ(charged.arcs.size(), plain.arcs.size());
    for (std::size_t a = 0; a < plain.arcs.size(); ++a) {
      EXPECT_EQ(charged.arcs[a].arc, plain.arcs[a].arc);
      EXPECT_NEAR(charged.arcs[a].weight, plain.arcs[a].weight, 1e-9);
    }
  }
}

// Dimensions in reverse order, and index i of M named M + 1 - i.
TEST(Marginals, FollowPermutedDimensionsAndIndices) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Solution solution = solve_k_best(support::random_problem(seed), 25);
    const auto renamed = [](const Tuple& arc) {
      Tuple other(arc.rbegin(), arc.rend());
      for (Index& i : other) i = i == 0 ? 0 : 4 - i;
      return other;
    };
    Solution other = solution;
    for (RankedSolution& rank : other.solutions) {
      for (Tuple& arc : rank.arcs) arc = renamed(arc);
      std::sort(rank.arcs.begin(), rank.arcs.end());
    }
    const Marginals plain = marginals(solution);
    const Marginals permuted = marginals(other);
    ASSERT_EQ(permuted.arcs.size(), plain.arcs.size());
    for (const ArcMarginal& arc : plain.arcs)
      EXPECT_DOUBLE_EQ(weight_of(permuted, renamed(arc.arc)), arc.weight);
    ASSERT_EQ(permuted.pairs.size(), plain.pairs.size());
    for (const PairMarginal& pair : plain.pairs) {
      EXPECT_NEAR(weight_of(permuted,
                            {2 - pair.second_dimension, 4 - pair.second},
                            {2 - pair.first_dimension, 4 - pair.first}),
                  pair.weight,
                  1e-15);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_DOUBLE_EQ(permuted.alone[2 - k][2 - i], plain.alone[k][i]);
    }
    ASSERT_EQ(permuted.ambiguous.size(), plain.ambiguous.size());
    for (std::size_t n = 0; n < plain.ambiguous.size(); ++n)
      EXPECT_NEAR(permuted.ambiguous[n].entropy, plain.ambiguous[n].entropy, 1e-12);
  }
}

TEST(Marginals, DoNotDependOnTheOrderOfTheRanks) {
  Solution solution = solve_k_best(support::random_problem(3), 20);
  const Marginals forwards = marginals(solution);
  std::reverse(solution.solutions.begin(), solution.solutions.end());
  const Marginals backwards = marginals(solution);
  EXPECT_EQ(backwards.weights,
            std::vector<double>(forwards.weights.rbegin(), forwards.weights.rend()));
  ASSERT_EQ(backwards.arcs.size(), forwards.arcs.size());
  for (std::size_t a = 0; a < forwards.arcs.size(); ++a)
    EXPECT_DOUBLE_EQ(backwards.arcs[a].weight, forwards.arcs[a].weight);
}

TEST(Marginals, OfOneSolutionAreCertain) {
  const Marginals result = marginals(solve_k_best(support::crossing_tracks().problem, 1));
  EXPECT_THAT(result.weights, ElementsAre(1));
  ASSERT_EQ(result.arcs.size(), 2u);
  EXPECT_EQ(result.arcs[0].weight, 1);
  EXPECT_EQ(result.pairs.size(), 6u);
  EXPECT_EQ(result.pairs[5].weight, 1);
  EXPECT_THAT(result.alone, ElementsAre(ElementsAre(0, 0), ElementsAre(0, 0), ElementsAre(0, 0)));
  EXPECT_THAT(result.ambiguous, IsEmpty());
}

TEST(Marginals, OfNoSolutionAreEmpty) {
  const Marginals result = marginals(rank_all(support::infeasible_by_hall().problem));
  EXPECT_THAT(result.weights, IsEmpty());
  EXPECT_THAT(result.arcs, IsEmpty());
  EXPECT_THAT(result.alone, IsEmpty());
}

TEST(Marginals, OfNothingToAssignHaveOneRank) {
  const Marginals result = marginals(rank_all(support::empty().problem));
  EXPECT_THAT(result.weights, ElementsAre(1));
  EXPECT_THAT(result.alone, ElementsAre(IsEmpty(), IsEmpty(), IsEmpty()));
}

const std::vector<Index> kTwoRows = {2, 1};

// Row 1, row 2 or none has the column, at these costs.
Marginals of_costs(double first, double second, double none) {
  return marginals(kTwoRows,
                   std::vector<RankedSolution>{
                       listed(first, {{1, 1}}), listed(second, {{2, 1}}), listed(none, {})});
}

TEST(Marginals, BearCostsOfAnySize) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  EXPECT_THAT(of_costs(-1e6, 0, 1e6).weights, ElementsAre(1, 0, 0));
  EXPECT_THAT(of_costs(-kLargest, 0, kLargest).weights, ElementsAre(1, 0, 0));
  EXPECT_THAT(of_costs(-kInfinity, 0, kInfinity).weights, ElementsAre(1, 0, 0));
  EXPECT_THAT(of_costs(0, 0, kInfinity).weights, ElementsAre(0.5, 0.5, 0));
  EXPECT_THAT(of_costs(kInfinity, kInfinity, kInfinity).weights,
              ElementsAre(1.0 / 3, 1.0 / 3, 1.0 / 3));
  EXPECT_THAT(of_costs(1e6, 1e6 + std::numbers::ln2, 2e6).weights,
              ElementsAre(DoubleNear(2.0 / 3, 1e-9), DoubleNear(1.0 / 3, 1e-9), 0));
  EXPECT_NEAR(of_costs(0, 700, kInfinity).weights[1] / std::exp(-700), 1, 1e-12);
}

// Certain or not by the solutions, whatever their weight; certainty in full where weights vanish.
TEST(Marginals, CallAmbiguousWhateverDiffers) {
  const Marginals result = of_costs(0, 1e6, 2e6);
  ASSERT_EQ(result.ambiguous.size(), 3u);
  EXPECT_EQ(result.ambiguous[0].dimension, 0);
  EXPECT_EQ(result.ambiguous[0].index, 1u);
  EXPECT_EQ(result.ambiguous[2].dimension, 1);
  EXPECT_THAT(result.ambiguous[2].arcs, ElementsAre(0, 1));
  for (const AmbiguousIndex& index : result.ambiguous) EXPECT_EQ(index.entropy, 0);
}

// w = e^-40 = 4.2e-18 cannot be seen in 1 - w: entropy w (40 + 1), of the column.
TEST(Marginals, KeepTheDigitsOfSmallEntropies) {
  const Marginals result = of_costs(0, 40, kInfinity);
  EXPECT_NEAR(result.ambiguous[0].entropy / (41 * std::exp(-40)), 1, 1e-12);
}

// A column that any of m rows may have, and equally well none: entropy ln(m + 1).
TEST(Marginals, AddUpToOneOverManyRanks) {
  constexpr Index kRows = 20000;
  std::vector<RankedSolution> ranks = {listed(-3, {})};
  for (Index i = 1; i <= kRows; ++i) ranks.push_back(listed(-3, {{i, 1}}));
  const Marginals result = marginals(std::vector<Index>{kRows, 1}, ranks);
  expect_sums_of_one(result);
  EXPECT_NEAR(result.ambiguous[0].entropy, std::log(kRows + 1.0), 1e-9);
  EXPECT_EQ(result.ambiguous[0].dimension, 1);
}

TEST(Marginals, ReadCostsInTheirUnit) {
  const std::vector<RankedSolution> ranks = {listed(0, {}),
                                             listed(2 * std::numbers::ln2, {{1, 1}})};
  EXPECT_THAT(marginals(kTwoRows, ranks).weights, ElementsAre(0.8, 0.2));
  EXPECT_THAT(marginals(kTwoRows, ranks, {2}).weights,
              ElementsAre(DoubleNear(2.0 / 3, 1e-15), DoubleNear(1.0 / 3, 1e-15)));
  EXPECT_THAT(marginals(kTwoRows, ranks, {1e-320}).weights, ElementsAre(1, 0));
  EXPECT_THAT(marginals(kTwoRows, ranks, {1e308}).weights, ElementsAre(0.5, 0.5));
}

TEST(Marginals, CountUnprovenRanksAndSaySo) {
  Options options;
  options.branch.max_nodes = 0;
  support::RandomProblemOptions random;
  random.sizes = {8, 8, 8};
  random.num_arcs = 300;
  const Problem problem = support::random_problem(2, random);
  Solution solution = solve_k_best(problem, 20, options);
  solution.marginals = marginals(solution);
  EXPECT_EQ(solution.marginals->weights.size(), 20u);
  EXPECT_EQ(solution.marginals->num_proven, num_proven(solution));
  EXPECT_LT(solution.marginals->num_proven, 20u);
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

TEST(Marginals, RefuseWhatIsNoListOfSolutions) {
  const auto message = [](const std::vector<RankedSolution>& ranks, double cost_per_nat) {
    try {
      marginals(std::vector<Index>{2, 2}, ranks, {cost_per_nat});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const RankedSolution right = listed(0, {{1, 1}, {2, 2}});
  EXPECT_EQ(message({right}, 1), "");
  for (const double wrong : {0.0, -1.0, kInfinity, std::nan("")})
    EXPECT_EQ(message({right}, wrong), "cost_per_nat must be a finite number above 0");
  EXPECT_EQ(message({right, listed(std::nan(""), {})}, 1),
            "number 2 of the solutions has a cost that is not a number");
  EXPECT_EQ(message({listed(0, {{1}})}, 1),
            "number 1 of the solutions has an arc of 1 indices, not 2");
  EXPECT_EQ(message({listed(0, {{1, 3}})}, 1),
            "number 1 of the solutions uses index 3 of dimension 2, which has 2");
  EXPECT_EQ(message({listed(0, {{1, 1}, {1, 1}})}, 1),
            "number 1 of the solutions has an arc twice");
  EXPECT_EQ(message({listed(0, {{2, 2}, {1, 1}})}, 1),
            "number 1 of the solutions has arcs that are not in order");
}

}  // namespace
}  // namespace nda
