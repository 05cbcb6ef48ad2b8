#include "recovery/recursive.hpp"

#include <vector>

#include "core/permuted.hpp"
#include "recovery/inner_problem.hpp"
#include "recovery/recovery_problem.hpp"
#include "relax/lagrangian.hpp"
#include "relax/set_order.hpp"

// The report's recursion: the recovery problem of an alignment is an assignment problem of one
// dimension less, solved by the same means.  With inner problems (the paper on partial branch and
// bound, section 2.2) its multipliers start at those that are best for the alignment.  Recovery
// problems keep two sets however many the point keeps: what makes relaxed problems dear would be
// paid at every recovery.  That of n - 1 kept sets is an assignment.

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Deadline;
using core::Packing;
using relax::RelaxedDual;

// The recovery problem drops a dimension, and with it arcs of two real indices may become
// singletons: (0, 0, i3, 0..) cannot occur, but a part may consist of one dimension only when every
// arc is (j, 0..0).
Packing solve_part(const Component& part,
                   std::span<const double> warm,
                   const RelaxationOptions& options,
                   const Deadline& deadline) {
  relax::LagrangianOptions loop = relax::loop_options(options, deadline);
  loop.max_evaluations = part.num_dimensions() == 2 ? 1 : options.recovery_evaluations;
  loop.recovery_interval = part.num_dimensions() <= 3 ? 1 : 0;
  loop.certify = false;
  const core::Permuted ordered(part, relax::set_order(part, options.recovery_order, loop));
  const Component& component = ordered.component();
  const auto recover = [&](const RelaxedDual& point) {
    return recover_recursively(component, point, options, deadline);
  };
  return ordered.to_source(
      relax::maximize_dual(component, ordered.from_source(warm), loop, recover).best);
}

// In two dimensions the relaxed solution is the solution.
Packing take_chosen(const Component& component, const RelaxedDual& point) {
  Packing packing;
  packing.arcs.assign(point.chosen_arcs().begin(), point.chosen_arcs().end());
  for (const ArcId a : packing.arcs) packing.cost += component.costs[a];
  return packing;
}

}  // namespace

Packing recover_recursively(const Component& component,
                            const RelaxedDual& point,
                            const RelaxationOptions& options,
                            const Deadline& deadline) {
  if (component.num_dimensions() == 2) return take_chosen(component, point);
  const RecoveryProblem problem =
      make_recovery_problem(component, point.cells(), point.aligned_cells(), deadline);
  const bool inner = options.inner_evaluations > 0 && component.num_dimensions() > 3;
  std::vector<double> u(inner ? component.num_slots() : 0);
  if (inner) point.multipliers(u);
  std::vector<ArcId> arcs;
  for (const Component& part : cut_parts(problem, deadline, options.decompose)) {
    std::vector<double> warm;
    if (inner) warm = maximize_inner({component, problem, part}, u, options, deadline).u;
    for (const ArcId a : solve_part(part, warm, options, deadline).arcs)
      arcs.push_back(part.arc_origin[a]);
  }
  return recovered_packing(component, problem, arcs);
}

}  // namespace nda::recovery
