#include "recovery/kept_solver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "relax/dual_function.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Random;
using relax::KeptAnswer;

constexpr double kTie = 1e-9;

// Three dimensions, what a relaxed problem is made of.
Component relaxed_problem(std::uint64_t seed) {
  support::RandomComponentOptions options;
  options.sizes = {3, 3, 3};
  options.num_arcs = 16;
  options.dummy_share = 0.2;
  return support::random_component(seed, options);
}

RelaxationOptions exact() {
  RelaxationOptions options;
  options.kept_sets = 3;
  return options;
}

RelaxationOptions inexact(int evaluations) {
  RelaxationOptions options = exact();
  options.kept_exact_arcs = 0;
  options.kept_evaluations = evaluations;
  return options;
}

void change_costs(Component& problem, Random& random) {
  for (double& cost : problem.costs) cost += random.uniform(-2, 2);
}

// Calls after calls, with costs that change as they do between evaluations.
template <typename Check>
void for_sequences(const RelaxationOptions& options, Check&& check) {
  const relax::KeptSolver solve = make_kept_solver(options, {});
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Component problem = relaxed_problem(seed);
    KeptAnswer answer;
    for (int call = 0; call < 5; ++call) {
      solve(problem, answer);
      check(problem, answer, support::best_cost(problem));
      change_costs(problem, random);
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(KeptSolver, IsExactWhereItSaysSo) {
  for_sequences(exact(), [](const Component& problem, const KeptAnswer& answer, double best) {
    EXPECT_TRUE(answer.exact);
    EXPECT_NEAR(answer.best.cost, best, kTie);
    EXPECT_NEAR(answer.lower, best, kTie);
    EXPECT_EQ(support::packing_fault(problem, answer.best), "");
  });
}

TEST(KeptSolver, BoundsFromBothSidesWithoutExactSearch) {
  for (const int evaluations : {1, 2, 20}) {
    int exact = 0;
    int inexact_ones = 0;
    for_sequences(inexact(evaluations),
                  [&](const Component& problem, const KeptAnswer& answer, double best) {
                    EXPECT_LE(answer.lower, best + kTie);
                    EXPECT_GE(answer.best.cost, best - kTie);
                    EXPECT_EQ(support::packing_fault(problem, answer.best), "");
                    EXPECT_EQ(support::multiplier_fault(problem, answer.u), "");
                    EXPECT_LE(support::sum_of(answer.u), answer.lower + kTie);
                    ++(answer.exact ? exact : inexact_ones);
                    if (answer.exact) {
                      EXPECT_NEAR(answer.best.cost, best, kTie);
                    }
                  });
    EXPECT_GT(exact, 0);
    EXPECT_GT(inexact_ones, 0);
  }
}

// At multipliers that are feasible the relaxed solution is empty, and no step follows that leaves
// them: half of what there is to gain was found so.
TEST(KeptSolver, FindsPackingsWithOneEvaluation) {
  double found = 0;
  double best_ones = 0;
  for_sequences(inexact(1), [&](const Component&, const KeptAnswer& answer, double best) {
    found += answer.best.cost;
    best_ones += best;
  });
  EXPECT_LE(found, 0.9 * best_ones);
}

TEST(KeptSolver, StopsAtItsLimitOfNodes) {
  RelaxationOptions options = exact();
  options.kept_nodes = 0;
  options.kept_evaluations = 1;
  for_sequences(options, [](const Component&, const KeptAnswer& answer, double best) {
    EXPECT_LE(answer.lower, best + kTie);
    EXPECT_EQ(answer.nodes, 0);
  });
}

TEST(KeptSolver, SaysNothingAfterTheDeadline) {
  KeptAnswer answer;
  make_kept_solver(exact(), core::Deadline(0))(relaxed_problem(1), answer);
  EXPECT_EQ(answer.lower, -kInfinity);
  EXPECT_FALSE(answer.exact);
}

// (4.5) and (4.6) with the multipliers of the relaxation below: Phi_2n at them is no more than
// Psi, which is no more than Phi_mn, which is what exact search finds.
TEST(MeritFunction, LiesBetweenTheDualFunctions) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Component component = support::random_component(seed, {{3, 3, 3, 2, 2}, 22, 0.25});
    for (const int m : {3, 4}) {
      relax::KeptSets kept;
      kept.num_kept = m;
      kept.solve = make_kept_solver(inexact(3), {});
      relax::KeptDual suboptimal(component, kept);
      kept.solve = make_kept_solver(exact(), {});
      relax::KeptDual optimal(component, kept);
      relax::DualFunction two(component);
      std::vector<double> u(suboptimal.num_variables());
      std::vector<double> g(u.size());
      for (double& multiplier : u) multiplier = random.uniform(-6, 1);
      for (int k = m; k < 5; ++k)
        u[component.offset[static_cast<std::size_t>(k)] - suboptimal.first_slot()] = 0;
      const double psi = suboptimal.evaluate(u, g);
      EXPECT_LE(psi, optimal.evaluate(u, g) + kTie);
      std::vector<double> all(component.num_slots());
      suboptimal.multipliers(all);
      std::copy(u.begin(), u.end(), all.begin() + suboptimal.first_slot());
      const std::span<const double> lower_ones = std::span(all).subspan(two.first_slot());
      std::vector<double> two_g(two.num_variables());
      const double phi_two = two.evaluate(lower_ones, two_g);
      EXPECT_LE(phi_two, optimal.evaluate(u, g) + kTie);
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace nda::recovery
