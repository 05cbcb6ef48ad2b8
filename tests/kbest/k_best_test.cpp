#include "nda/k_best.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "cost_checks.hpp"
#include "nda/check.hpp"
#include "nda/generate.hpp"
#include "nda/solve.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda {
namespace {

using ::testing::IsEmpty;

TEST(KBest, AgreesWithBruteForce) {
  int compared = 0;
  for (std::uint64_t seed = 1; compared < 5000 && seed < 10000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const std::optional<std::vector<double>> all = all_costs(random.problem);
    if (!all) continue;
    bool is_lost = false;
    for (const std::size_t k : {std::size_t{2}, std::size_t{7}, all->size() + 1}) {
      const Solution solution = solve_k_best(random.problem, k);
      is_lost = solution.status == Status::kPrecisionLost;
      if (is_lost) break;
      expect_sound(random.problem, solution);
      expect_costs(random.problem, *all, k, costs_of(solution.solutions));
      EXPECT_EQ(num_proven(solution), solution.solutions.size());
      EXPECT_TRUE(!solution.lists_all || solution.solutions.size() == all->size());
      EXPECT_TRUE(solution.lists_all || all->empty() || k <= all->size());
    }
    compared += is_lost ? 0 : 1;
    if (HasFatalFailure() || HasNonfatalFailure()) break;
  }
  EXPECT_EQ(compared, 5000);
}

// Eight rows and columns, all pairs: far more solutions than are asked for.
Problem square(std::uint64_t seed) {
  support::RandomProblemOptions options;
  options.sizes = {8, 8, 8};
  options.num_arcs = 300;
  return support::random_problem(seed, options);
}

TEST(KBest, BeginsWithTheBest) {
  const Problem problem = square(1);
  const Solution best = solve(problem);
  const std::vector<double> hundred = costs_of(solve_k_best(problem, 100).solutions);
  ASSERT_EQ(hundred.size(), 100u);
  EXPECT_DOUBLE_EQ(hundred.front(), best.cost);
  EXPECT_EQ(costs_of(solve_k_best(problem, 1).solutions), std::vector<double>{best.cost});
  const std::vector<double> ten = costs_of(solve_k_best(problem, 10).solutions);
  for (std::size_t r = 0; r < 10; ++r) EXPECT_NEAR(ten[r], hundred[r], 1e-9);
}

TEST(KBest, NeedsAtLeastOneSolution) {
  EXPECT_THROW(solve_k_best(square(1), 0), InputError);
}

// Plain relaxation leaves solutions that a neighbour improves on: the best one comes first.
TEST(KBest, PutsABetterNeighbourFirst) {
  Options options;
  options.method = Method::kRelaxation;
  options.relaxation.max_evaluations = 1;
  int improved = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Problem problem = square(seed);
    const double plain = solve(problem, options).cost;
    const Solution solution = solve_k_best(problem, 10, options);
    expect_sound(problem, solution);
    EXPECT_EQ(solution.cost, solution.solutions.front().cost);
    EXPECT_LE(solution.cost, plain);
    EXPECT_LE(solution.lower_bound, solution.cost);
    improved += solution.cost < plain;
    const std::vector<double> costs = costs_of(solution.solutions);
    EXPECT_TRUE(std::ranges::is_sorted(costs));
  }
  EXPECT_GT(improved, 0);
}

// Costs overflow: leaving all alone is all that solve() has, at 0.  The best neighbour meets the
// bound but for rounding, which proves nothing of costs that large.
TEST(KBest, BringsNoLostPrecisionBack) {
  ProblemBuilder builder({2, 2, 2});
  builder.add_arc({1, 1, 1}, -1e300);
  builder.add_arc({2, 2, 2}, 1e300);
  builder.add_arc({1, 2, 1}, -1);
  const Problem problem = std::move(builder).build();
  const std::string reason = solve(problem).reason;
  EXPECT_FALSE(reason.empty());
  for (const RankingMethod method : {RankingMethod::kExact, RankingMethod::kAlignments}) {
    Options options;
    options.ranking.method = method;
    const Solution solution = solve_k_best(problem, 5, options);
    EXPECT_EQ(solution.status, Status::kPrecisionLost);
    EXPECT_EQ(solution.reason, reason);
    EXPECT_FALSE(solution.proven);
    EXPECT_EQ(num_proven(solution), 0u);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
  EXPECT_EQ(solve_k_best(problem, 5).cost, -1e300);
}

// Sums of such costs are infinite, and differences of infinities are no numbers.
TEST(KBest, RanksNothingByAlignmentsWhereCostsOverflow) {
  ProblemBuilder builder({4, 4, 4});
  for (Index i = 1; i <= 4; ++i) {
    for (Index j = 1; j <= 4; ++j) builder.add_arc({i, j, 1 + (i * j) % 4}, -9e306 * i * j);
  }
  const Problem problem = std::move(builder).build();
  for (const RankingMethod method : {RankingMethod::kAlignments, RankingMethod::kMurty}) {
    Options options;
    options.method = Method::kRelaxation;
    options.relaxation.dual_method = DualMethod::kVolume;
    options.ranking.method = method;
    const Solution solution = solve_k_best(problem, 5, options);
    EXPECT_EQ(solution.status, Status::kPrecisionLost);
    EXPECT_EQ(solution.cost, 0);
    EXPECT_EQ(num_proven(solution), 0u);
    EXPECT_THAT(check(problem, solution).faults, IsEmpty());
  }
}

TEST(KBest, HasNothingToRankWhereThereIsNoSolution) {
  ProblemBuilder builder({2, 1});
  builder.add_arc({1, 1}, 3);
  builder.add_arc({2, 1}, 4);
  builder.add_arc({1, 0}, kInfinity);
  builder.add_arc({2, 0}, kInfinity);
  const Solution solution = solve_k_best(std::move(builder).build(), 5);
  EXPECT_EQ(solution.status, Status::kInfeasible);
  EXPECT_THAT(solution.solutions, IsEmpty());
}

// Without the arcs that `drop` says.
template <typename Drop>
Problem without(const Problem& problem, Drop&& drop) {
  ProblemBuilder builder({problem.sizes().begin(), problem.sizes().end()});
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    if (!drop(problem.arc(a))) builder.add_arc(problem.arc(a), problem.costs()[a]);
  }
  for (int d = 0; d < problem.num_dimensions(); ++d) {
    for (Index i = 1; i <= problem.size(d); ++i) {
      std::vector<Index> tuple(problem.sizes().size(), 0);
      tuple[static_cast<std::size_t>(d)] = i;
      builder.add_arc(tuple, problem.singleton_costs(d)[i]);
    }
  }
  return std::move(builder).build();
}

// Of a problem whose indices must all be used, by solving it anew for every arc of every rank
// (Murty 1968): what was not solved by ranking tells what it should have found.
std::vector<double> costs_by_murty(const Problem& problem, std::size_t k) {
  std::vector<std::pair<Problem, Solution>> open;
  std::vector<double> costs;
  open.emplace_back(problem, solve(problem));
  while (costs.size() < k && !open.empty()) {
    const auto least = std::min_element(open.begin(), open.end(), [](const auto& a, const auto& b) {
      return a.second.cost < b.second.cost;
    });
    Problem rest = least->first;
    const Solution best = least->second;
    open.erase(least);
    costs.push_back(best.cost);
    for (const std::vector<Index>& arc : best.solutions.front().arcs) {
      Problem child = without(rest, [&](const auto& other) { return other == arc; });
      Solution solution = solve(child);
      EXPECT_TRUE(solution.proven || solution.status == Status::kInfeasible);
      if (solution.proven) open.emplace_back(std::move(child), std::move(solution));
      rest = without(rest, [&](const auto& other) {
        bool shares = false;
        for (std::size_t d = 0; d < arc.size(); ++d) shares = shares || other[d] == arc[d];
        return shares && other != arc;
      });
    }
  }
  return costs;
}

// So hard that cuts tighten what is ranked.
TEST(KBest, AgreesWithMurtyWhereCutsAreNeeded) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    SCOPED_TRACE(seed);
    Map3Options map3;
    map3.size = 16;
    map3.seed = seed;
    const Problem problem = generate_map3(map3).problem;
    const Solution solution = solve_k_best(problem, 8);
    EXPECT_EQ(num_proven(solution), 8u);
    expect_sound(problem, solution);
    expect_costs(problem, costs_by_murty(problem, 8), 8, costs_of(solution.solutions));
  }
}

// Where nothing is proven, what differs by one arc follows, without a claim.
TEST(KBest, ClaimsNothingOfWhatALimitLeftOpen) {
  const Problem problem = square(2);
  for (const std::int64_t max_nodes : {0, 1, 30}) {
    Options options;
    options.branch.max_nodes = max_nodes;
    const Solution solution = solve_k_best(problem, 20, options);
    ASSERT_EQ(solution.solutions.size(), 20u);
    expect_sound(problem, solution);
    const std::vector<double> truth = costs_of(solve_k_best(problem, 20).solutions);
    for (std::size_t r = 0; r < 20; ++r) {
      EXPECT_GE(solution.solutions[r].cost, truth[r] - 1e-9);
      if (solution.solutions[r].proven) {
        EXPECT_NEAR(solution.solutions[r].cost, truth[r], 1e-9);
      }
    }
  }
}

TEST(KBest, StopsRankingOnDemand) {
  Options options;
  std::stop_source source;
  source.request_stop();
  options.stop = source.get_token();
  const Solution solution = solve_k_best(square(3), 10, options);
  EXPECT_EQ(num_proven(solution), 0u);
  expect_sound(square(3), solution);
}

// The best one takes hundredths of a second, so many take far more than the second after which the
// callback is told.
TEST(KBest, TellsThatItIsRankingAndStopsWhenTold) {
  support::RandomProblemOptions random;
  random.sizes = {18, 18, 18};
  random.num_arcs = 9000;
  random.costs = support::CostKind::kInteger;
  random.dummy_share = 0;
  Options options;
  std::vector<std::string> events;
  options.progress = [&](const Progress& now) {
    events.push_back(now.event);
    return events.back() != "ranking";
  };
  const Problem problem = support::random_problem(1, random);
  const Solution solution = solve_k_best(problem, 3000, options);
  EXPECT_EQ(std::count(events.begin(), events.end(), "ranking"), 1);
  EXPECT_LT(num_proven(solution), solution.solutions.size());
  EXPECT_THAT(check(problem, solution).faults, IsEmpty());
}

// Costs times a power of two and with a charge for every index of one dimension rank alike.
TEST(KBest, RanksScaledAndShiftedProblemsAlike) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Problem problem = square(seed);
    ProblemBuilder builder({8, 8, 8});
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      const std::vector<Index> tuple = problem.arc(a);
      builder.add_arc(tuple, 4 * problem.costs()[a] + (tuple[1] != 0 ? 100 : 0));
    }
    for (Index i = 1; i <= 8; ++i) builder.add_arc({0, i, 0}, 100);
    const std::vector<double> costs = costs_of(solve_k_best(problem, 40).solutions);
    const std::vector<double> other =
        costs_of(solve_k_best(std::move(builder).build(), 40).solutions);
    ASSERT_EQ(costs.size(), other.size());
    for (std::size_t r = 0; r < costs.size(); ++r) EXPECT_NEAR(other[r], 4 * costs[r] + 800, 1e-7);
  }
}

// Costs of all sizes: two solutions cost the same up to rounding, and ranking has the other first.
TEST(KBest, CostsWhatItsFirstRankCosts) {
  const Problem problem = support::make_problem({4, 1, 3},
                                                {{{4, 1, 2}, -41508825.51677927},
                                                 {{2, 1, 0}, -87317713132.03326},
                                                 {{0, 1, 3}, -382394467.1991042},
                                                 {{3, 0, 3}, -38435365357.6526},
                                                 {{4, 0, 3}, 5072.455327766079},
                                                 {{4, 1, 3}, -814613629382.9437},
                                                 {{2, 1, 2}, 0.021497794332682042},
                                                 {{1, 1, 1}, -5.918650983600635e-09},
                                                 {{1, 1, 2}, -7.609294145830435},
                                                 {{2, 1, 1}, -7.771023631335665e-07},
                                                 {{2, 0, 3}, -11988.477866590896},
                                                 {{2, 0, 0}, 1.4068090765011652e-07},
                                                 {{4, 0, 0}, -57745728161.38247},
                                                 {{0, 0, 1}, kInfinity},
                                                 {{0, 0, 3}, 0.16951929619711104}});
  const Solution solution = solve_k_best(problem, 3, {});
  ASSERT_FALSE(solution.solutions.empty());
  EXPECT_EQ(solution.cost, solution.solutions.front().cost);
  EXPECT_THAT(check(problem, solution).faults, ::testing::IsEmpty());
}

}  // namespace
}  // namespace nda
