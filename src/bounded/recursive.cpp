#include "bounded/recursive.hpp"

#include <vector>

#include "bounded/lagrangian.hpp"
#include "bounded/parts.hpp"
#include "bounded/recovery_problem.hpp"

namespace nda::bounded {
namespace {

using core::ArcId;

Choice solve_part(const BoundedComponent& part,
                  const RelaxationOptions& options,
                  const core::Deadline& deadline) {
  const int dimensions = part.graph.num_dimensions();
  LagrangianOptions loop;
  loop.dual_method = options.dual_method;
  loop.max_evaluations = dimensions <= 2 ? 1 : options.recovery_evaluations;
  loop.recovery_interval = dimensions <= 3 ? 1 : 0;
  loop.certify = false;
  loop.deadline = deadline;
  const std::vector<double> start(part.rows.size(), 0.0);
  return maximize_dual(part,
                       start,
                       loop,
                       [&](const RelaxedDual& point) {
                         return recover_recursively(part, point, options, deadline);
                       })
      .best;
}

}  // namespace

Choice recover_recursively(const BoundedComponent& component,
                           const RelaxedDual& point,
                           const RelaxationOptions& options,
                           const core::Deadline& deadline) {
  const std::span<const ArcId> chosen = point.chosen_arcs();
  if (component.graph.num_dimensions() <= 2)
    return make_choice(component, {chosen.begin(), chosen.end()});
  const BoundedComponent problem =
      make_recovery_problem(component, point.cells(), chosen, point.reduced_costs());
  std::vector<ArcId> arcs;
  for (const BoundedComponent& part : cut_parts(problem, deadline, options.decompose)) {
    for (const ArcId a : solve_part(part, options, deadline).arcs)
      arcs.push_back(problem.graph.arc_origin[part.graph.arc_origin[a]]);
  }
  return make_choice(component, std::move(arcs));
}

}  // namespace nda::bounded
