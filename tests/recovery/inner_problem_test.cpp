#include "recovery/inner_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "relax/lagrangian.hpp"
#include "support/brute_force.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::Component;

// (2.2) of the paper on partial branch and bound: at the same multipliers the inner problem's value
// is no less than that of the dual, and it bounds what the alignment can give.
TEST(InnerProblem, LiesBetweenTheDualAndTheRecoveryProblem) {
  int tighter = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    if (component.num_dimensions() < 3) continue;
    relax::LagrangianOptions loop;
    loop.max_evaluations = 3;
    loop.num_alignments = 3;
    const relax::LagrangianResult relaxed = relax::maximize_dual(component, {}, loop, {});
    const relax::Cells cells = relax::find_cells(component);
    double size = 1;
    for (const double cost : component.costs) size += std::abs(cost);
    for (const relax::Alignment& alignment : relaxed.alignments) {
      const RecoveryProblem problem = make_recovery_problem(component, cells, alignment.cells);
      std::vector<double> u(component.num_slots(), 0.0);
      std::copy_backward(alignment.point.begin(), alignment.point.end(), u.end());
      double lower = recovered_packing(component, problem, {}).cost;
      double best = lower;
      for (const Component& part : cut_parts(problem)) {
        RelaxationOptions options;
        options.inner_evaluations = 5;
        const InnerResult inner = maximize_inner({component, problem, part}, u, options, {});
        const double optimum = support::brute_force(support::to_problem(part))->cost;
        EXPECT_LE(inner.lower, optimum + 1e-9 * size);
        EXPECT_EQ(inner.u.size(), part.num_slots());
        lower += inner.lower;
        best += optimum;
      }
      EXPECT_GE(lower, alignment.value - 1e-9 * size);
      tighter += lower > alignment.value + 1e-6 * size;
    }
  }
  EXPECT_GT(tighter, 100);
}

}  // namespace
}  // namespace nda::recovery
