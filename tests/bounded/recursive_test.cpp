#include "bounded/recursive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bounded/dual_function.hpp"
#include "bounded/recovery_problem.hpp"
#include "bounded_parts.hpp"
#include "small_components.hpp"

namespace nda::bounded {
namespace {

using core::ArcId;
using core::Random;
using ::testing::ElementsAre;

constexpr double kTie = 1e-8;

void evaluate(DualFunction& function, std::span<const double> u) {
  std::vector<double> subgradient(function.num_variables());
  function.evaluate(u.subspan(function.first_slot()), subgradient);
}

// Tracks 1 and 2 share measurement 1 of the first scan, bounds 1..2 and singleton 5: two aligned
// cells, (1,1) and (2,1).  The measurement must be used once: that is asked of (1,1), whose arc is
// the cheapest, together with track 1 (singleton 3), and taken off its arcs; of (2,1) track 2 alone
// asks.
TEST(BoundedRecoveryProblem, AsksTheFirstUseOfASharedMeasurement) {
  BoundedComponent component{core::make_component({2, 1, 2}), {}};
  core::append_arc(component.graph, std::vector<Index>{1, 1, 1}, -4);
  core::append_arc(component.graph, std::vector<Index>{1, 1, 2}, -2);
  core::append_arc(component.graph, std::vector<Index>{2, 1, 1}, -3);
  component.rows.resize(component.graph.num_slots());
  component.rows[1] = component.rows[2] = {3, 1, 1, false, false};
  component.rows[component.graph.offset[1] + 1] = {5, 1, 2, false, false};
  for (const Index i : {1u, 2u})
    component.rows[component.graph.offset[2] + i] = {0, 0, 1, false, false};
  DualFunction point(component);
  evaluate(point, std::vector<double>(component.rows.size(), 0.0));
  ASSERT_THAT(point.chosen_arcs(), ElementsAre(0, 2));
  const BoundedComponent problem =
      make_recovery_problem(component, point.cells(), point.chosen_arcs(), point.reduced_costs());
  EXPECT_THAT(problem.graph.sizes, ElementsAre(2, 2));
  EXPECT_THAT(problem.graph.costs, ElementsAre(-12, -10, -6));
  EXPECT_THAT(problem.graph.arc_origin, ElementsAre(0, 1, 2));
  // Measurement 1 of the second scan may be used once: track 1 goes on with 2.
  const Choice choice = recover_recursively(component, point, {}, {});
  EXPECT_THAT(choice.arcs, ElementsAre(1, 2));
  EXPECT_EQ(choice.cost, -5);
}

// What a choice costs more than its recovery problem says: as the alignment does, whose relaxed
// uses count alike.
double constant_of(const BoundedComponent& component,
                   const BoundedComponent& problem,
                   std::span<const ArcId> chosen) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < problem.num_arcs(); ++a) {
    const bool aligned =
        std::binary_search(chosen.begin(), chosen.end(), problem.graph.arc_origin[a]);
    if (aligned && problem.graph.index(0, a) != 0) arcs.push_back(a);
  }
  const std::vector<ArcId> origin = core::at_positions(problem.graph.arc_origin, arcs);
  return make_choice(component, origin).cost - make_choice(problem, arcs).cost;
}

// What a recovery problem says its choices cost, and a constant, is no less than what they cost;
// and the same where the alignment uses no index more often than it must be.
TEST(BoundedRecoveryProblem, NeverPromisesTooMuch) {
  int exact = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    Random random(seed);
    const int m = 2 + static_cast<int>(random.below(2));
    if (component.graph.num_dimensions() <= m) continue;
    std::vector<ArcId> chosen;
    RelaxedChoices(component, m, [&](const std::vector<ArcId>& arcs) {
      if (arcs.size() >= chosen.size() && random.below(3) == 0) chosen = arcs;
    });
    const std::vector<double> reduced(component.graph.costs);
    const Cells cells = find_cells(component.graph, m);
    const BoundedComponent problem = make_recovery_problem(component, cells, chosen, reduced);
    const std::vector<Index> aligned = count_uses(component.graph, chosen);
    bool is_exact = true;
    for (std::uint32_t slot = 0; slot < component.graph.offset[static_cast<std::size_t>(m)]; ++slot)
      is_exact =
          is_exact && (component.rows[slot].lo == 0 || aligned[slot] <= component.rows[slot].lo);
    exact += is_exact ? 1 : 0;
    const double constant = constant_of(component, problem, chosen);
    const int all = problem.graph.num_dimensions();
    RelaxedChoices(problem, all, [&](const std::vector<ArcId>& arcs) {
      const double promised = make_choice(problem, arcs).cost + constant;
      const std::vector<ArcId> origin = core::at_positions(problem.graph.arc_origin, arcs);
      const Choice choice = make_choice(component, origin);
      EXPECT_LE(choice.cost, promised + kTie);
      if (is_exact) {
        EXPECT_NEAR(choice.cost, promised, kTie);
      }
      const std::vector<Index> uses = count_uses(component.graph, choice.arcs);
      for (std::uint32_t slot = 0; slot < uses.size(); ++slot)
        EXPECT_LE(uses[slot], component.rows[slot].hi);
    });
    if (HasFailure()) return;
  }
  EXPECT_GT(exact, 100);
}

// (3.9): within the bounds, and never better than the best.
TEST(BoundedRecovery, IsFeasible) {
  int best = 0;
  int all = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    Random random(seed);
    DualFunction point(component);
    evaluate(point, random_multipliers(component, random));
    const Choice choice = recover_recursively(component, point, {}, {});
    std::uint64_t bits = 0;
    for (const ArcId a : choice.arcs) bits |= std::uint64_t{1} << a;
    EXPECT_NEAR(choice_of(component, bits).cost, choice.cost, kTie);
    const double least = best_choice(component).cost;
    EXPECT_GE(choice.cost, least - kTie);
    ++all;
    best += choice.cost <= least + kTie ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(best, all / 3);
}

// A relaxed solution that exceeds no relaxed bound and lacks nothing it has not paid for is the
// best; recovery finds nothing worse.  Two dimensions are the simplest case.
TEST(BoundedRecovery, IsTheOptimumInTwoDimensions) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    if (component.graph.num_dimensions() > 2) continue;
    ++num_compared;
    DualFunction point(component);
    evaluate(point, std::vector<double>(component.rows.size(), 0.0));
    EXPECT_NEAR(
        recover_recursively(component, point, {}, {}).cost, best_choice(component).cost, kTie);
  }
  EXPECT_GT(num_compared, 200);
}

// In three dimensions the recovery problem is a flow: its best choice by listing all is found.
TEST(BoundedRecovery, IsTheBestOfTheAlignmentInThreeDimensions) {
  int num_compared = 0;
  for (std::uint64_t seed = 0; seed < 5000; ++seed) {
    SCOPED_TRACE(seed);
    const BoundedComponent component = small_component(seed);
    if (component.graph.num_dimensions() != 3) continue;
    ++num_compared;
    Random random(seed);
    DualFunction point(component);
    evaluate(point, random_multipliers(component, random));
    const BoundedComponent problem =
        make_recovery_problem(component, point.cells(), point.chosen_arcs(), point.reduced_costs());
    const Choice promised = best_choice(problem);
    const double constant = constant_of(component, problem, point.chosen_arcs());
    EXPECT_LE(recover_recursively(component, point, {}, {}).cost, promised.cost + constant + kTie);
    if (HasFailure()) return;
  }
  EXPECT_GT(num_compared, 500);
}

TEST(BoundedRecovery, LeavesOverWhatTheDeadlineForbids) {
  const BoundedComponent component = small_component(11);
  DualFunction point(component);
  evaluate(point, std::vector<double>(component.rows.size(), 0.0));
  const Choice choice = recover_recursively(component, point, {}, core::Deadline(0));
  EXPECT_GE(choice.cost, best_choice(component).cost - kTie);
}

}  // namespace
}  // namespace nda::bounded
