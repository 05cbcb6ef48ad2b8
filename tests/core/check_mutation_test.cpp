#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/right_solution.hpp"
#include "nda/check.hpp"
#include "support/matchers.hpp"
#include "support/random_problems.hpp"

// Right solutions of random problems, each changed at random in one place.  A change that alters
// what the solution claims to a wrong claim must be rejected; whether it does is decided here with
// the means of tests/support, not with those of the checker.

namespace nda {
namespace {

using core::Random;
using support::Tuples;

enum Mutation {
  kDropArc,
  kRepeatArc,
  kAddArc,
  kReplaceArc,
  kChangeIndex,
  kChangeCost,
  kChangeBothCosts,
  kRaiseBound,
  kChangeMultiplier,
  kBreakMultiplier,
  kSwapDimensions,
  kNumMutations,
};

const char* const kNames[kNumMutations] = {"drop an arc",
                                           "repeat an arc",
                                           "add an arc",
                                           "replace an arc",
                                           "change an index",
                                           "change the cost",
                                           "change both costs",
                                           "raise the bound",
                                           "change a multiplier",
                                           "break a multiplier",
                                           "swap two dimensions"};

void change_multiplier(Solution& solution, Random& random, bool break_it) {
  std::vector<double>& row = solution.multipliers[random.below(solution.multipliers.size())];
  double& u = row[random.below(row.size())];
  if (!break_it) {
    u += random.uniform(-5, 5);
  } else if (random.below(3) == 0) {
    row.pop_back();
  } else {
    u = random.below(2) == 0 ? std::nan("") : kInfinity;
  }
}

void change_arcs(Tuples& arcs, const Problem& problem, Mutation mutation, Random& random) {
  if (mutation == kAddArc) {
    if (problem.num_arcs() > 0) arcs.push_back(problem.arc(random.below(problem.num_arcs())));
    return;
  }
  if (arcs.empty()) return;
  std::vector<Index>& arc = arcs[random.below(arcs.size())];
  const std::size_t k = random.below(arc.size());
  switch (mutation) {
    case kDropArc:
      std::swap(arc, arcs.back());
      arcs.pop_back();
      return;
    case kRepeatArc:
      arcs.push_back(std::vector<Index>(arc));
      return;
    case kReplaceArc:
      arc = problem.arc(random.below(problem.num_arcs()));
      return;
    case kChangeIndex:
      arc[k] = static_cast<Index>(random.below(problem.sizes()[k] + 2));
      return;
    default:
      std::swap(arc[k], arc[random.below(arc.size())]);
      return;
  }
}

void mutate(Solution& solution, const Problem& problem, Mutation mutation, Random& random) {
  RankedSolution& best = solution.solutions.front();
  const double change = random.uniform(-3, 3);
  switch (mutation) {
    case kChangeCost:
      (random.below(2) == 0 ? best.cost : solution.cost) += change;
      return;
    case kChangeBothCosts:
      solution.cost = best.cost += change;
      return;
    case kRaiseBound:
      solution.lower_bound += std::abs(change);
      return;
    case kChangeMultiplier:
    case kBreakMultiplier:
      return change_multiplier(solution, random, mutation == kBreakMultiplier);
    default:
      return change_arcs(best.arcs, problem, mutation, random);
  }
}

// The least that an index can cost if every arc pays u for it, by trying all numbers of arcs.  The
// cost bends at lo, and without a limit it either grows from there on or falls for ever.
long double least_cost(UseBounds bounds, double singleton, double u) {
  const bool unlimited = bounds.hi == UseBounds::kUnlimited;
  if (!std::isfinite(u)) return std::nanl("");
  if (unlimited && u < 0) return -kInfinity;
  long double least = kInfinity;
  for (Index n = 0; n <= (unlimited ? bounds.lo : bounds.hi); ++n) {
    for (Index y = 0; n + y <= (unlimited ? bounds.lo : bounds.hi); ++y) {
      if (n + y < bounds.lo || (y > 0 && singleton == kInfinity)) continue;
      least = std::min(least, static_cast<long double>(u) * n + (y > 0 ? y * singleton : 0));
    }
  }
  return least;
}

// The sum of that and of min(0, reduced cost) over the arcs, in long double; NaN where the
// multipliers do not fit.
long double certified(const Problem& problem, const Solution& solution) {
  const auto& u = solution.multipliers;
  long double bound = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const std::vector<double>& row = u[static_cast<std::size_t>(k)];
    if (row.size() != problem.size(k)) return std::nanl("");
    for (Index i = 1; i <= problem.size(k); ++i) {
      bound += least_cost(problem.use_bounds(k, i), problem.singleton_costs(k)[i], row[i - 1]);
    }
  }
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    long double reduced = problem.costs()[a];
    const std::vector<Index> tuple = problem.arc(a);
    for (std::size_t k = 0; k < tuple.size(); ++k) reduced -= tuple[k] ? u[k][tuple[k] - 1] : 0;
    bound += std::min(0.0L, reduced);
  }
  return bound;
}

enum class Claim { kTrue, kFalse, kTooCloseToTell };

Claim judge(const Problem& problem, const Solution& solution) {
  const RankedSolution& best = solution.solutions.front();
  if (!support::infeasibility(problem, best.arcs).empty()) return Claim::kFalse;
  const double cost_error = std::max(std::abs(support::cost_of(problem, best.arcs) - best.cost),
                                     std::abs(solution.cost - best.cost));
  const long double right = certified(problem, solution);
  const bool nothing = right == -kInfinity && solution.lower_bound == -kInfinity;
  const long double bound_error = nothing ? 0 : solution.lower_bound - right;
  if (!(cost_error <= 1e-6 && bound_error <= 1e-6)) return Claim::kFalse;
  // Next to 0 rounding decides how far a bound lies below.
  if (std::abs(right) < 1e-12L && solution.lower_bound != right) return Claim::kTooCloseToTell;
  const bool is_true = cost_error <= 1e-12 && bound_error <= 1e-10L * std::abs(right);
  return is_true ? Claim::kTrue : Claim::kTooCloseToTell;
}

Problem planted_problem(std::uint64_t seed) {
  Random random(seed);
  support::RandomProblemOptions options;
  options.sizes.assign(2 + random.below(3), 1 + static_cast<Index>(random.below(4)));
  options.singletons = static_cast<support::SingletonKind>(random.below(4));
  options.costs = random.below(2) == 0 ? support::CostKind::kFew : support::CostKind::kDecimal;
  options.sign = static_cast<support::SignKind>(random.below(3));
  options.plant = true;
  return support::random_problem(seed, options);
}

Problem bounded_problem(std::uint64_t seed) {
  return support::random_bounded_case(seed).problem;
}

// Changes the right solution of each feasible problem in one place.
void expect_rejections(Problem (*make)(std::uint64_t), std::uint64_t num_seeds, int least) {
  std::vector<int> num_false(kNumMutations, 0);
  for (std::uint64_t seed = 0; seed < num_seeds; ++seed) {
    const Problem problem = make(seed);
    const auto best = support::brute_force(problem);
    if (!best) continue;
    Random random(seed ^ 0x6d757461ULL);
    Solution solution =
        core::right_solution(problem, *best, core::random_multipliers(problem, random, 0.3));
    const auto mutation = static_cast<Mutation>(random.below(kNumMutations));
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << kNames[mutation]);
    ASSERT_THAT(check(problem, solution).faults, ::testing::IsEmpty());
    mutate(solution, problem, mutation, random);
    const Claim claim = judge(problem, solution);
    num_false[mutation] += claim == Claim::kFalse;
    if (claim != Claim::kTooCloseToTell) {
      EXPECT_EQ(check(problem, solution).passed(), claim == Claim::kTrue)
          << ::testing::PrintToString(check(problem, solution).faults);
    }
  }
  for (int m = 0; m < kNumMutations; ++m) EXPECT_GT(num_false[m], least) << kNames[m];
}

TEST(Check, RejectsMutationsThatChangeTheMeaningAndOnlyThose) {
  expect_rejections(planted_problem, 4000, 60);
}

TEST(Check, RejectsMutationsOfManyToOneSolutions) {
  expect_rejections(bounded_problem, 8000, 60);
}

}  // namespace
}  // namespace nda
