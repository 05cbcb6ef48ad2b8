#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bounded/bound.hpp"
#include "bounded/dual_function.hpp"
#include "bounded/kept_dual.hpp"
#include "bounded/kept_solver.hpp"
#include "bounded/separable_dual.hpp"
#include "bounded_parts.hpp"
#include "small_components.hpp"
#include "support/evaluation.hpp"

// The theorems of the report's sections 3 and 4 with bounds on uses, on ten thousand random
// components of two to six dimensions, every number of kept dimensions.

namespace nda::bounded {
namespace {

using core::ArcId;
using core::Random;
using support::evaluate;

constexpr double kTie = 1e-8;
constexpr std::uint64_t kComponents = 10000;

// Stands in for the layer above: the best choice of a relaxed problem, by listing all.
void solve_exactly(const BoundedComponent& problem, KeptAnswer& answer) {
  answer.best = best_choice(problem);
  answer.exact = true;
  answer.lower = answer.best.cost;
  answer.u.assign(problem.rows.size(), 0.0);
}

// The same without an optimum: some choice, and the bound of some multipliers.
void solve_badly(const BoundedComponent& problem, KeptAnswer& answer) {
  solve_exactly(problem, answer);
  if (!answer.best.arcs.empty()) answer.best.arcs.pop_back();
  answer.best = make_choice(problem, answer.best.arcs);
  answer.exact = false;
  Random random(problem.num_arcs());
  answer.u = random_multipliers(problem, random);
  answer.lower = lagrangian_bound(problem, answer.u);
}

template <typename Check>
void for_all_relaxations(Check&& check) {
  for (std::uint64_t seed = 0; seed < kComponents; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    Random random(seed);
    const std::vector<double> u = random_multipliers(component, random);
    for (int m = 0; m < component.graph.num_dimensions(); ++m) {
      SCOPED_TRACE("m = " + std::to_string(m));
      check(component, m, u, random);
    }
    if (testing::Test::HasFailure()) return;
  }
}

// Theorems 3.1 and 3.2 for best solutions: the collapsed problem costs what (3.2) does, and so does
// the choice of arcs that it gives, which keeps to the kept bounds.
TEST(BoundedTheorems, ValuesTransferFromTheCollapsedProblemAndBack) {
  int with_bounds = 0;
  for_all_relaxations([&](const BoundedComponent& component, int m, const auto& u, Random&) {
    with_bounds += std::any_of(component.rows.begin() + 1, component.rows.end(), [](auto& row) {
      return row.hi > 1 || row.lo != row.hi;
    });
    const double least = least_relaxed_cost(component, m, u);
    KeptDual function(component, m, solve_exactly);
    EXPECT_NEAR(evaluate(function, u).value, least, kTie);
    EXPECT_NEAR(relaxed_cost(component, m, u, function.chosen_arcs()), least, kTie);
    EXPECT_LE(function.bound(), least);
    EXPECT_GE(function.bound(), least - kTie);
    if (m > 2) return;
    DualFunction flow(component, m);
    EXPECT_NEAR(evaluate(flow, u).value, least, kTie);
    EXPECT_NEAR(relaxed_cost(component, m, u, flow.chosen_arcs()), least, kTie);
    const std::vector<Index> uses = count_uses(component.graph, flow.chosen_arcs());
    for (std::uint32_t slot = 0; slot < flow.first_slot(); ++slot)
      EXPECT_LE(uses[slot], component.rows[slot].hi);
  });
  EXPECT_GT(with_bounds, 20000);
}

// Theorem 3.1 for a choice of the kept dimensions that is not the best: w^n is feasible for (3.2)
// and costs as much.
TEST(BoundedTheorems, SuboptimalChoicesTransferToo) {
  for_all_relaxations([](const BoundedComponent& component, int m, const auto& u, Random&) {
    KeptDual function(component, m, solve_badly, false);
    const double value = evaluate(function, u).value;
    EXPECT_NEAR(value, relaxed_cost(component, m, u, function.chosen_arcs()), kTie);
    const std::vector<Index> uses = count_uses(component.graph, function.chosen_arcs());
    for (std::uint32_t slot = 0; slot < function.first_slot(); ++slot)
      EXPECT_LE(uses[slot], component.rows[slot].hi);
  });
}

// Theorem 3.2: whatever is feasible for (3.2) gives uses of cells (3.6), as many as its arcs, that
// the collapsed problem allows and that cost no more.
TEST(BoundedTheorems, EveryRelaxedChoiceCollapsesAtNoHigherCost) {
  for_all_relaxations([](const BoundedComponent& component, int m, const auto& u, Random&) {
    const Cells cells = find_cells(component.graph, m);
    RelaxedChoices(component, m, [&](const std::vector<ArcId>& arcs) {
      std::vector<ArcId> collapsed;
      for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
        std::vector<ArcId> of_cell(cells[cell].begin(), cells[cell].end());
        std::sort(of_cell.begin(), of_cell.end(), [&](ArcId a, ArcId b) {
          return reduced(component, m, u, a) < reduced(component, m, u, b);
        });
        auto uses =
            static_cast<std::size_t>(std::count_if(of_cell.begin(), of_cell.end(), [&](ArcId a) {
              return std::binary_search(arcs.begin(), arcs.end(), a);
            }));
        if (cell < cells.num_free) {
          uses =
              static_cast<std::size_t>(std::count_if(of_cell.begin(), of_cell.end(), [&](ArcId a) {
                return reduced(component, m, u, a) < 0;
              }));
        } else {
          EXPECT_LE(uses, most_uses_of_cell(component, m, of_cell.front()));
        }
        collapsed.insert(
            collapsed.end(), of_cell.begin(), of_cell.begin() + static_cast<std::ptrdiff_t>(uses));
      }
      EXPECT_LE(relaxed_cost(component, m, u, collapsed),
                relaxed_cost(component, m, u, arcs) + kTie);
    });
  });
}

// Theorem 4.1: (4.2a), and (4.2b) at any multipliers; nothing kept is the separable dual.
TEST(BoundedTheorems, MoreKeptDimensionsAreNoWorseAndNoneExceedsTheOptimum) {
  for (std::uint64_t seed = 0; seed < kComponents; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    Random random(seed);
    const std::vector<double> u = random_multipliers(component, random);
    std::vector<double> subgradient(u.size());
    double less_kept = SeparableDual(component).evaluate(u, subgradient);
    EXPECT_LE(lagrangian_bound(component, u), less_kept + kTie);
    DualFunction nothing(component, 0);
    EXPECT_NEAR(evaluate(nothing, u).value, less_kept, kTie);
    for (int m = 1; m <= component.graph.num_dimensions(); ++m) {
      KeptDual function(component, m, solve_exactly);
      const double value = evaluate(function, u).value;
      EXPECT_GE(value, less_kept - kTie) << "m = " << m;
      less_kept = value;
    }
    EXPECT_NEAR(less_kept, best_choice(component).cost, kTie);
    if (HasFailure()) return;
  }
}

// Theorem 4.1, Definition 4.2 and (4.4).
TEST(BoundedTheorems, DualFunctionsAreConcaveAndSupportedByTheirSubgradients) {
  for_all_relaxations([](const BoundedComponent& component, int m, const auto& u, Random& random) {
    KeptDual function(component, m, solve_exactly);
    const std::vector<double> w = random_multipliers(component, random);
    support::expect_concave(function, u, w, kTie);
  });
}

// What may only be held back (lo = 0) has no positive multiplier, what may only be asked for (as
// many uses as arcs) no negative one, what must be used so often may have any up to its singleton;
// and no value is lost.
TEST(BoundedTheorems, SignsOfMultipliersCostNothing) {
  for_all_relaxations([](const BoundedComponent& component, int m, const auto& u, Random&) {
    std::vector<double> v = u;
    clamp(component, v);
    core::for_each_index(component.graph, [&](std::uint32_t slot, std::size_t, Index) {
      const Row& row = component.rows[slot];
      EXPECT_LE(v[slot], row.lo == 0 ? 0.0 : std::max(row.single, 0.0));
      if (row.is_open) {
        EXPECT_GE(v[slot], std::min(row.single, 0.0));
      }
    });
    KeptDual function(component, m, solve_exactly);
    const double value = evaluate(function, u).value;
    EXPECT_GE(evaluate(function, v).value, value - kTie);
  });
}

// Theorem 4.3 (4.6), with relaxed problems that are not solved to their optimum.
TEST(BoundedTheorems, TheMeritFunctionNeverExceedsTheDualFunction) {
  for_all_relaxations([](const BoundedComponent& component, int m, const auto& u, Random&) {
    KeptDual function(component, m, solve_badly);
    const double value = evaluate(function, u).value;
    EXPECT_LE(value, least_relaxed_cost(component, m, u) + kTie);
    EXPECT_LE(function.bound(), value);
    std::vector<double> all(component.rows.size());
    function.multipliers(all);
    EXPECT_LE(lagrangian_bound(component, all), value + kTie);
  });
}

// (4.5) as the engine has it: relaxed problems solved by relaxation alone, from the last
// multipliers; Phi_2n at the multipliers of the levels below is no more than Phi_mn.
TEST(BoundedTheorems, TheMeritFunctionOfTheRecursionLiesBelow) {
  RelaxationOptions options;
  options.kept_sets = 64;
  options.kept_exact_arcs = 0;
  options.kept_evaluations = 2;
  int inexact = 0;
  for_all_relaxations([&](const BoundedComponent& component, int m, const auto& u, Random&) {
    if (m < 3) return;
    const double least = least_relaxed_cost(component, m, u);
    KeptDual function(component, m, make_kept_solver(options, {}));
    const double value = evaluate(function, u).value;
    EXPECT_LE(value, least + kTie);
    EXPECT_LE(function.bound(), value);
    inexact += function.answer().exact ? 0 : 1;
    std::vector<double> all(component.rows.size());
    function.multipliers(all);
    DualFunction two(component);
    EXPECT_LE(evaluate(two, all).value, least + kTie);
  });
  EXPECT_GT(inexact, 400);
}

// The engine's exact way finds what listing all finds, and says so.
TEST(BoundedTheorems, TheKeptSolverIsExactWhereItSaysSo) {
  const KeptSolver solve = make_kept_solver({}, {});
  for (std::uint64_t seed = 0; seed < kComponents; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    KeptAnswer answer;
    solve(component, answer);
    const double least = best_choice(component).cost;
    EXPECT_TRUE(answer.exact);
    EXPECT_NEAR(answer.best.cost, least, kTie);
    EXPECT_LE(answer.lower, least + kTie);
    EXPECT_GE(answer.lower, least - kTie);
    EXPECT_LE(lagrangian_bound(component, answer.u), least + kTie);
    if (HasFailure()) return;
  }
}

TEST(BoundedTheorems, NothingIsProvenAfterTheDeadline) {
  const BoundedComponent component = small_component(7);
  KeptAnswer answer;
  make_kept_solver({}, core::Deadline(0))(component, answer);
  EXPECT_EQ(answer.lower, -kInfinity);
  EXPECT_FALSE(answer.exact);
}

}  // namespace
}  // namespace nda::bounded
