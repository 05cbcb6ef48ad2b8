#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/marginals.hpp"
#include "support/many_to_one_problems.hpp"

// Marginals where bounds on uses let a solution have several arcs of an index.

namespace nda {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Tuple = std::vector<Index>;
using Place = std::pair<int, Index>;

// Four solutions: both do at 5, the first alone at 6, the
// second alone at 7, nobody at 9; they weigh 0.657233, 0.241782, 0.088947 and 0.012038.
//   arc (1,1)     0.657233 + 0.241782 = 0.899015,   arc (2,1)  0.657233 + 0.088947 = 0.746180
//   the detection: four uses, -sum w ln w = 0.887543
TEST(SharedMarginals, OfASharedDetectionAreThoseOfTheComment) {
  const Problem problem = support::shared_detection();
  Solution solution = solve_k_best(problem, 9);
  solution.marginals = marginals(solution);
  const Marginals& result = *solution.marginals;
  ASSERT_EQ(result.weights.size(), 4u);
  EXPECT_NEAR(result.weights[0], 0.657233, 1e-6);
  ASSERT_EQ(result.arcs.size(), 2u);
  EXPECT_NEAR(result.arcs[0].weight, 0.899015, 1e-6);
  EXPECT_NEAR(result.arcs[1].weight, 0.746180, 1e-6);
  EXPECT_NEAR(result.alone[1][0], 0.012038, 1e-6);
  ASSERT_EQ(result.ambiguous.size(), 3u);
  EXPECT_EQ(result.ambiguous[0].dimension, 1);
  EXPECT_NEAR(result.ambiguous[0].entropy, 0.887543, 1e-6);
  EXPECT_THAT(result.ambiguous[0].arcs, ElementsAre(0u, 1u));
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

// Both arcs of the first solution have the pair of 1 and 1: it weighs what the solution does.
TEST(SharedMarginals, CountAPairOnceForEachSolution) {
  const std::vector<RankedSolution> ranks = {{1, 0, true, {{1, 1, 1}, {1, 1, 2}}},
                                             {2, 0, true, {{1, 1, 1}}}};
  const Marginals result = marginals(std::vector<Index>{1, 1, 2}, ranks);
  ASSERT_EQ(result.pairs.size(), 5u);
  EXPECT_EQ(result.pairs[0].second_dimension, 1);
  EXPECT_DOUBLE_EQ(result.pairs[0].weight, 1);
  EXPECT_DOUBLE_EQ(result.pairs[2].weight, 0.5) << "1 of dimension 1, 2 of dimension 3";
  EXPECT_EQ(result.alone[0][0], 0);
  ASSERT_EQ(result.ambiguous.size(), 3u);
  EXPECT_NEAR(result.ambiguous[0].entropy, std::log(2), 1e-15) << "both arcs, or one";
}

// By the definition, index by index.
struct Posterior {
  std::map<Tuple, double> arcs;
  std::map<std::pair<Place, Place>, double> pairs;
  std::map<Place, std::map<std::set<Tuple>, double>> uses;
};

Posterior posterior(const Solution& solution, const std::vector<double>& weights) {
  Posterior result;
  for (std::size_t r = 0; r < weights.size(); ++r) {
    std::map<Place, std::set<Tuple>> uses;
    std::set<std::pair<Place, Place>> pairs;
    for (int k = 0; k < static_cast<int>(solution.sizes.size()); ++k) {
      for (Index i = 1; i <= solution.sizes[static_cast<std::size_t>(k)]; ++i) uses[{k, i}] = {};
    }
    for (const Tuple& arc : solution.solutions[r].arcs) {
      result.arcs[arc] += weights[r];
      for (auto& [place, use] : uses) {
        if (arc[static_cast<std::size_t>(place.first)] != place.second) continue;
        use.insert(arc);
        for (int k = place.first + 1; k < static_cast<int>(arc.size()); ++k) {
          const Index i = arc[static_cast<std::size_t>(k)];
          if (i != 0) pairs.insert({place, {k, i}});
        }
      }
    }
    for (const auto& pair : pairs) result.pairs[pair] += weights[r];
    for (const auto& [place, use] : uses) result.uses[place][use] += weights[r];
  }
  return result;
}

double entropy_of(const std::map<std::set<Tuple>, double>& uses) {
  double entropy = 0;
  for (const auto& [use, weight] : uses) entropy -= weight > 0 ? weight * std::log(weight) : 0;
  return entropy;
}

void expect_posterior(const Marginals& actual, Posterior expected) {
  ASSERT_EQ(actual.arcs.size(), expected.arcs.size());
  for (const ArcMarginal& arc : actual.arcs) EXPECT_NEAR(arc.weight, expected.arcs[arc.arc], 1e-9);
  ASSERT_EQ(actual.pairs.size(), expected.pairs.size());
  for (const PairMarginal& pair : actual.pairs) {
    const Place first = {pair.first_dimension, pair.first};
    const Place second = {pair.second_dimension, pair.second};
    EXPECT_NEAR(pair.weight, expected.pairs.at({first, second}), 1e-9);
  }
  std::size_t ambiguous = 0;
  for (auto& [place, uses] : expected.uses) {
    ambiguous += uses.size() > 1 ? 1 : 0;
    const auto k = static_cast<std::size_t>(place.first);
    EXPECT_NEAR(actual.alone[k][place.second - 1], uses[{}], 1e-9);
  }
  ASSERT_EQ(actual.ambiguous.size(), ambiguous);
  for (const AmbiguousIndex& index : actual.ambiguous)
    EXPECT_NEAR(index.entropy, entropy_of(expected.uses[{index.dimension, index.index}]), 1e-9);
}

bool shares_an_index(const Solution& solution) {
  for (const RankedSolution& rank : solution.solutions) {
    std::set<Place> used;
    for (const Tuple& arc : rank.arcs) {
      for (std::size_t k = 0; k < arc.size(); ++k) {
        if (arc[k] != 0 && !used.insert({static_cast<int>(k), arc[k]}).second) return true;
      }
    }
  }
  return false;
}

// All solutions, and the first few; nda::check() computes the marginals a third time.
TEST(SharedMarginals, AreThoseOfTheDefinition) {
  int shared = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    support::BoundedKind kind;
    kind.dimensions = 2 + static_cast<int>(seed % 4);
    kind.num_arcs = 5 + static_cast<int>(seed % 6);
    kind.tight = seed % 5 == 0;
    kind.integer = seed % 2 == 0;
    const Problem problem = support::random_bounded_problem(seed, kind);
    for (const std::size_t k : {std::size_t{4}, std::size_t{2000}}) {
      Solution solution = solve_k_best(problem, k);
      if (solution.solutions.empty()) continue;
      solution.marginals = marginals(solution, {5});
      expect_posterior(*solution.marginals, posterior(solution, solution.marginals->weights));
      EXPECT_THAT(check(problem, solution).faults, IsEmpty());
      shared += shares_an_index(solution) ? 1 : 0;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(shared, 1000);
}

}  // namespace
}  // namespace nda
