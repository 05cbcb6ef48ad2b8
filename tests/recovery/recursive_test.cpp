#include "recovery/recursive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "recovery/packing_state.hpp"
#include "recovery/recovery_problem.hpp"
#include "relax/dual_function.hpp"
#include "support/components.hpp"
#include "support/tiny_problems.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using relax::DualFunction;
using support::packing_fault;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kTie = 1e-9;

using Tuple = std::vector<Index>;
using Cell = std::pair<Index, Index>;

Component component_of(std::vector<Index> sizes,
                       const std::vector<std::pair<Tuple, double>>& arcs) {
  Component component = core::make_component(std::move(sizes));
  for (const auto& arc : arcs) core::append_arc(component, arc.first, arc.second);
  return component;
}

void evaluate_at_zero(DualFunction& function) {
  const std::vector<double> u(function.num_variables(), 0.0);
  std::vector<double> g(u.size());
  function.evaluate(u, g);
}

std::vector<Tuple> tuples_of(const Component& component) {
  std::vector<Tuple> tuples;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    tuples.emplace_back();
    for (int k = 0; k < component.num_dimensions(); ++k) {
      tuples.back().push_back(component.index(k, a));
    }
  }
  return tuples;
}

// At u = 0 the pairs (1,1) and (2,2) are chosen.  By (3.7) rows 1 and 2 own what continues them,
// (1,2,*) is gone.
TEST(RecoveryProblem, MakesOneRowOfEveryAlignedPair) {
  const Component component = component_of(
      {2, 2, 2},
      {{{1, 1, 1}, -4}, {{1, 1, 2}, -5}, {{1, 2, 1}, -1}, {{2, 2, 1}, -2}, {{2, 2, 2}, -4}});
  DualFunction point(component);
  evaluate_at_zero(point);
  const RecoveryProblem problem =
      make_recovery_problem(component, point.cells(), point.aligned_cells());
  EXPECT_THAT(problem.component.sizes, ElementsAre(2, 2));
  EXPECT_THAT(tuples_of(problem.component),
              ElementsAre(Tuple{1, 1}, Tuple{1, 2}, Tuple{2, 1}, Tuple{2, 2}));
  EXPECT_THAT(problem.component.costs, ElementsAre(-4, -5, -2, -4));
  EXPECT_THAT(problem.component.arc_origin, ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(problem.default_arc, ElementsAre(kNoArc, kNoArc, kNoArc));
}

// Eq. (3.8): (1,1,0) -3 is what row 1 costs when it stays alone; it is shifted away, and (1,1,1)
// -2 cannot improve on it.
TEST(RecoveryProblem, ShiftsTheArcThatEndsARowAway) {
  const Component component =
      component_of({1, 1, 2}, {{{1, 1, 0}, -3}, {{1, 1, 1}, -2}, {{1, 1, 2}, -7}});
  DualFunction point(component);
  evaluate_at_zero(point);
  const RecoveryProblem problem =
      make_recovery_problem(component, point.cells(), point.aligned_cells());
  EXPECT_THAT(tuples_of(problem.component), ElementsAre(Tuple{1, 2}));
  EXPECT_THAT(problem.component.costs, ElementsAre(-4));
  EXPECT_THAT(problem.default_arc, ElementsAre(kNoArc, 0));
}

// An arc (1,1,0) that costs something is never a default: the row may stay uncovered for nothing.
TEST(RecoveryProblem, LeavesDearEndsOut) {
  const Component component = component_of({1, 1, 2}, {{{1, 1, 0}, 3}, {{1, 1, 2}, -7}});
  DualFunction point(component);
  evaluate_at_zero(point);
  const RecoveryProblem problem =
      make_recovery_problem(component, point.cells(), point.aligned_cells());
  EXPECT_THAT(problem.component.costs, ElementsAre(-7));
  EXPECT_THAT(problem.default_arc, ElementsAre(kNoArc, kNoArc));
}

// Arcs of cell (0, 0) belong to row 0 whether the relaxed solution took them or not.
TEST(RecoveryProblem, KeepsTheCellOfTwoDummiesFree) {
  const Component component = support::whole_component(support::zero_zero_cell().problem);
  DualFunction point(component);
  const std::vector<double> u = {0, -9, -9, 0, -9, -9};
  std::vector<double> g(u.size());
  point.evaluate(u, g);
  ASSERT_THAT(point.chosen_arcs(), IsEmpty()) << "all are too dear there";
  const RecoveryProblem problem =
      make_recovery_problem(component, point.cells(), point.aligned_cells());
  EXPECT_THAT(problem.component.sizes, ElementsAre(0, 2, 2));
  EXPECT_THAT(tuples_of(problem.component), ElementsAre(Tuple{0, 1, 1}, Tuple{0, 2, 2}));
  EXPECT_THAT(problem.component.costs, ElementsAre(-2, -3));
  EXPECT_THAT(problem.component.arc_origin, ElementsAre(0, 1));
}

// What a recovery problem must hold, from its definition.
struct Expected {
  Tuple tuple;
  double cost;
  ArcId origin;
};

std::vector<Expected> naive_recovery(const Component& component,
                                     const std::map<Cell, Index>& rows,
                                     std::vector<ArcId>& default_arc) {
  const auto cell_of = [&](ArcId a) { return Cell{component.index(0, a), component.index(1, a)}; };
  const auto ends = [&](ArcId a) {
    bool all_dummies = true;
    for (int k = 2; k < component.num_dimensions(); ++k) {
      all_dummies = all_dummies && component.index(k, a) == 0;
    }
    return all_dummies;
  };
  std::map<Cell, double> base;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const auto row = rows.find(cell_of(a));
    if (row == rows.end() || !ends(a) || component.costs[a] >= 0) continue;
    base[row->first] = component.costs[a];
    default_arc[row->second] = a;
  }
  std::vector<Expected> arcs;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const auto row = rows.find(cell_of(a));
    if (row == rows.end() || ends(a)) continue;
    const double cost = component.costs[a] - base[row->first];
    if (cost >= 0) continue;
    Tuple tuple = {row->second};
    for (int k = 2; k < component.num_dimensions(); ++k) tuple.push_back(component.index(k, a));
    arcs.push_back({std::move(tuple), cost, a});
  }
  std::sort(arcs.begin(), arcs.end(), [](const Expected& a, const Expected& b) {
    return a.tuple < b.tuple;
  });
  return arcs;
}

// A random component and its dual function at a random point.
struct RandomPoint {
  Component component;
  DualFunction function;

  explicit RandomPoint(std::uint64_t seed)
      : component(support::random_component_of_any_kind(seed)), function(component) {
    core::Random random(seed);
    std::vector<double> u(function.num_variables());
    for (double& multiplier : u) multiplier = random.uniform(-6, 1);
    for (const std::uint32_t dummy : component.offset) {
      if (dummy >= function.first_slot()) u[dummy - function.first_slot()] = 0;
    }
    std::vector<double> g(u.size());
    function.evaluate(u, g);
  }

  std::map<Cell, Index> rows() const {
    std::vector<std::uint32_t> cells(function.aligned_cells().begin(),
                                     function.aligned_cells().end());
    std::sort(cells.begin(), cells.end());
    std::map<Cell, Index> rows = {{{0, 0}, 0}};
    for (std::size_t j = 0; j < cells.size(); ++j) {
      rows[{function.cells().row[cells[j]], function.cells().column[cells[j]]}] =
          static_cast<Index>(j + 1);
    }
    return rows;
  }
};

TEST(RecoveryProblem, IsTheOneOfItsDefinition) {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    const RandomPoint point(seed);
    if (point.component.num_dimensions() == 2) continue;
    const std::map<Cell, Index> rows = point.rows();
    std::vector<ArcId> default_arc(rows.size(), kNoArc);
    const std::vector<Expected> expected = naive_recovery(point.component, rows, default_arc);
    const RecoveryProblem problem = make_recovery_problem(
        point.component, point.function.cells(), point.function.aligned_cells());
    EXPECT_EQ(problem.component.sizes[0], rows.size() - 1);
    EXPECT_EQ(problem.default_arc, default_arc);
    ASSERT_EQ(problem.component.num_arcs(), expected.size());
    const std::vector<Tuple> tuples = tuples_of(problem.component);
    for (std::size_t a = 0; a < expected.size(); ++a) {
      EXPECT_EQ(tuples[a], expected[a].tuple);
      EXPECT_DOUBLE_EQ(problem.component.costs[a], expected[a].cost);
      EXPECT_EQ(problem.component.arc_origin[a], expected[a].origin);
    }
  }
}

TEST(RecoverRecursively, IsFeasibleForEveryMethodAndCostsNothingAtWorst) {
  for (std::uint64_t seed = 0; seed < 700; ++seed) {
    SCOPED_TRACE(seed);
    const RandomPoint point(seed);
    core::Random random(seed);
    RelaxationOptions options;
    options.dual_method = static_cast<DualMethod>(random.below(3));
    options.assign2d = static_cast<Assign2dMethod>(random.below(3));
    options.recovery_evaluations = 1 + static_cast<int>(random.below(20));
    const Packing packing = recover_recursively(point.component, point.function, options, {});
    EXPECT_EQ(packing_fault(point.component, packing), "");
    EXPECT_LE(packing.cost, 0);
    EXPECT_GE(packing.cost, support::best_cost(point.component) - kTie);
    EXPECT_TRUE(std::is_sorted(packing.arcs.begin(), packing.arcs.end()));
  }
}

TEST(RecoverRecursively, OfTwoDimensionsIsTheOptimum) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomComponentOptions options;
    options.sizes = {4, 5};
    options.dummy_share = 0;
    const Component component = support::random_component(seed, options);
    DualFunction point(component);
    evaluate_at_zero(point);
    EXPECT_NEAR(
        recover_recursively(component, point, {}, {}).cost, support::best_cost(component), kTie);
  }
}

Packing best_packing(const Component& component) {
  Packing best;
  for (const Packing& packing : support::all_packings(component)) {
    if (packing.cost < best.cost) best = packing;
  }
  return best;
}

// Three dimensions: the recovery problem has two and is solved exactly, so nothing is lost as long
// as the alignment holds the pairs of an optimal solution.
TEST(RecoverRecursively, OfThreeDimensionsFindsTheOptimumFromItsAlignment) {
  int num_aligned = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component(seed);
    DualFunction function(component);
    core::Random random(seed);
    std::vector<double> u(function.num_variables());
    for (double& multiplier : u) multiplier = random.uniform(-4, 0);
    u[0] = 0;
    std::vector<double> g(u.size());
    function.evaluate(u, g);
    std::vector<Cell> aligned = {{0, 0}};
    for (const std::uint32_t cell : function.aligned_cells()) {
      aligned.push_back({function.cells().row[cell], function.cells().column[cell]});
    }
    const Packing best = best_packing(component);
    const bool holds = std::all_of(best.arcs.begin(), best.arcs.end(), [&](ArcId a) {
      const Cell cell{component.index(0, a), component.index(1, a)};
      return std::find(aligned.begin(), aligned.end(), cell) != aligned.end();
    });
    if (!holds) continue;
    ++num_aligned;
    EXPECT_NEAR(recover_recursively(component, function, {}, {}).cost, best.cost, kTie);
  }
  EXPECT_GT(num_aligned, 200);
}

TEST(RecoverRecursively, StaysFeasibleAfterTheDeadline) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const RandomPoint point(seed);
    const Packing packing =
        recover_recursively(point.component, point.function, {}, core::Deadline(0));
    EXPECT_EQ(packing_fault(point.component, packing), "");
    EXPECT_LE(packing.cost, 0);
  }
}

}  // namespace
}  // namespace nda::recovery
