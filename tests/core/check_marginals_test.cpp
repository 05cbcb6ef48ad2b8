#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nda/check.hpp"
#include "nda/k_best.hpp"
#include "nda/marginals.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

// Right marginals changed in one place: the checker must tell.

namespace nda {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Solution ranked(const Problem& problem, std::size_t k) {
  Solution solution = solve_k_best(problem, k);
  solution.marginals = marginals(solution);
  return solution;
}

using Change = std::function<void(Marginals&)>;

// Every number of the list made a little larger, a little smaller, and none.
void change_numbers(const Marginals& right,
                    const std::function<std::vector<double*>(Marginals&)>& numbers,
                    std::vector<Change>& changes) {
  Marginals copy = right;
  for (std::size_t n = 0; n < numbers(copy).size(); ++n) {
    for (const double factor : {1 + 1e-6, 1 - 1e-6, std::nan("")}) {
      changes.push_back([=](Marginals& marginals) {
        double& number = *numbers(marginals)[n];
        number = number == 0 ? 1e-6 * factor : number * factor;
      });
    }
  }
}

template <typename Item>
void change_list(const std::vector<Item>& right,
                 std::vector<Item> Marginals::*list,
                 std::vector<Change>& changes) {
  for (std::size_t n = 0; n < right.size(); ++n) {
    changes.push_back([=](Marginals& marginals) {
      auto& items = marginals.*list;
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(n));
    });
    changes.push_back([=](Marginals& marginals) {
      auto& items = marginals.*list;
      items.push_back(items[n]);
    });
  }
}

std::vector<Change> all_changes(const Marginals& right) {
  std::vector<Change> changes;
  const auto every = [&](const auto& numbers) { change_numbers(right, numbers, changes); };
  every([](Marginals& marginals) {
    std::vector<double*> numbers;
    for (double& weight : marginals.weights) numbers.push_back(&weight);
    for (ArcMarginal& arc : marginals.arcs) numbers.push_back(&arc.weight);
    for (PairMarginal& pair : marginals.pairs) numbers.push_back(&pair.weight);
    for (AmbiguousIndex& index : marginals.ambiguous) numbers.push_back(&index.entropy);
    for (std::vector<double>& row : marginals.alone) {
      for (double& weight : row) numbers.push_back(&weight);
    }
    return numbers;
  });
  change_list(right.weights, &Marginals::weights, changes);
  change_list(right.arcs, &Marginals::arcs, changes);
  change_list(right.pairs, &Marginals::pairs, changes);
  change_list(right.alone, &Marginals::alone, changes);
  change_list(right.ambiguous, &Marginals::ambiguous, changes);
  const std::vector<Change> others = {
      [](Marginals& m) { m.cost_per_nat = 0; },
      [](Marginals& m) { m.cost_per_nat = -1; },
      [](Marginals& m) { m.cost_per_nat = kInfinity; },
      [](Marginals& m) { m.cost_per_nat = std::nan(""); },
      [](Marginals& m) { m.cost_per_nat *= 2; },
      [](Marginals& m) { --m.num_proven; },
      [](Marginals& m) { ++m.num_proven; },
      [](Marginals& m) { std::swap(m.arcs.front().arc, m.arcs.back().arc); },
      [](Marginals& m) { m.arcs.front().arc.front() += 1; },
      [](Marginals& m) { std::swap(m.pairs.front(), m.pairs.back()); },
      [](Marginals& m) { ++m.pairs.front().second; },
      [](Marginals& m) { ++m.pairs.front().second_dimension; },
      [](Marginals& m) { m.alone.front().push_back(0); },
      [](Marginals& m) { std::swap(m.ambiguous.front(), m.ambiguous.back()); },
      [](Marginals& m) { m.ambiguous.front().dimension = 63; },
      [](Marginals& m) { m.ambiguous.front().arcs.pop_back(); },
      [](Marginals& m) { m.ambiguous.front().arcs.push_back(m.arcs.size()); },
      [](Marginals& m) { m.ambiguous.front().arcs.push_back(m.ambiguous.front().arcs.back()); },
      [](Marginals& m) {
        std::swap(m.ambiguous.front().arcs.front(), m.ambiguous.front().arcs.back());
      },
  };
  changes.insert(changes.end(), others.begin(), others.end());
  return changes;
}

void expect_changes_denied(const Problem& problem, std::size_t least_changes) {
  const Solution right = ranked(problem, 10);
  const CheckReport report = check(problem, right);
  EXPECT_THAT(report.faults, IsEmpty());
  EXPECT_TRUE(report.marginals_right);
  const std::vector<Change> changes = all_changes(*right.marginals);
  EXPECT_GT(changes.size(), least_changes);
  for (std::size_t n = 0; n < changes.size(); ++n) {
    SCOPED_TRACE("change " + std::to_string(n));
    Solution wrong = right;
    changes[n](*wrong.marginals);
    const CheckReport verdict = check(problem, wrong);
    EXPECT_THAT(verdict.faults, ElementsAre(StartsWith("marginals: ")));
    EXPECT_FALSE(verdict.marginals_right);
  }
}

// crossing_tracks: seven solutions, of which the weights of all arcs differ.
TEST(CheckMarginals, DenyWhateverIsChanged) {
  expect_changes_denied(support::crossing_tracks().problem, 150);
}

// Arcs (1,1,1), (1,1,2) and (2,1,1), at -3, -2 and -1, of which any may be chosen: eight solutions.
TEST(CheckMarginals, DenyChangesWhereIndicesAreShared) {
  ProblemBuilder builder({2, 1, 2});
  builder.add_arc({1, 1, 1}, -3);
  builder.add_arc({1, 1, 2}, -2);
  builder.add_arc({2, 1, 1}, -1);
  builder.set_use_bounds(0, 1, {0, 2});
  builder.set_use_bounds(1, 1, {0, UseBounds::kUnlimited});
  builder.set_use_bounds(2, 1, {0, 2});
  expect_changes_denied(std::move(builder).build(), 70);
}

TEST(CheckMarginals, DenyThoseOfAnotherList) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Problem problem = support::random_problem(seed);
    Solution solution = ranked(problem, 20);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
    solution.solutions.pop_back();
    EXPECT_THAT(check(problem, solution).faults, ElementsAre(StartsWith("marginals: ")));
  }
}

TEST(CheckMarginals, SayNothingOfWhatIsNoSolution) {
  const Problem problem = support::crossing_tracks().problem;
  Solution solution = ranked(problem, 3);
  solution.solutions[1].arcs.push_back({9, 9, 9});
  const CheckReport report = check(problem, solution);
  EXPECT_FALSE(report.marginals_right);
  for (const std::string& fault : report.faults)
    EXPECT_THAT(fault, ::testing::Not(StartsWith("marginals: ")));
}

TEST(CheckMarginals, OfNoSolutionAreEmpty) {
  const Problem problem = support::infeasible_by_hall().problem;
  Solution solution = ranked(problem, 3);
  EXPECT_TRUE(check(problem, solution).marginals_right);
  solution.marginals->weights = {1};
  EXPECT_THAT(check(problem, solution).faults, ElementsAre(StartsWith("marginals: 1 weights")));
}

}  // namespace
}  // namespace nda
