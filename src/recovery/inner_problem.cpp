#include "recovery/inner_problem.hpp"

#include <algorithm>

#include "recovery/packing_state.hpp"
#include "relax/lagrangian.hpp"

// An alignment forbids all other pairs (i1, i2), so the best dual value of the arcs it leaves is a
// better bound on what it can give than that of all arcs, and the multipliers that attain it are a
// better start for the recovery problem, which has the same relaxed indices but one.  As the
// recovery problem falls apart, so does the inner one: each part is maximised by itself.

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;

struct Inner {
  std::vector<ArcId> arcs;  // ascending
  double default_cost = 0;  // with every row left alone: the recovery problem does not count it
};

Inner inner_of(const RecoveryPart& from) {
  Inner inner;
  Index last = 0;
  for (const ArcId in_problem : from.part.arc_origin) {
    const Index row = from.problem.component.index(0, in_problem);
    const ArcId default_arc = from.problem.default_arc[row];
    if (row != last && default_arc != kNoArc) {
      inner.arcs.push_back(default_arc);
      inner.default_cost += from.component.costs[default_arc];
    }
    last = row;
    inner.arcs.push_back(from.problem.component.arc_origin[in_problem]);
  }
  return inner;
}

// Multipliers of the part, those of its rows 0: dimension d of the recovery problem is dimension
// d + m - 1 of the component.
std::vector<double> of_part(const RecoveryPart& from, std::span<const double> u) {
  std::vector<double> part_u(from.part.num_slots(), 0.0);
  const auto skipped = static_cast<std::size_t>(from.problem.num_kept) - 1;
  core::for_each_index(from.part, [&](std::uint32_t slot, std::size_t d, Index i) {
    if (d > 0) part_u[slot] = u[from.component.offset[d + skipped] + i];
  });
  return part_u;
}

}  // namespace

InnerResult maximize_inner(const RecoveryPart& from,
                           std::span<const double> u,
                           const RelaxationOptions& options,
                           const core::Deadline& deadline) {
  core::Cutter cutter;
  const Inner inner = inner_of(from);
  const Component component = cutter.cut(from.component, inner.arcs);
  relax::LagrangianOptions loop = relax::loop_options(options, deadline);
  loop.max_evaluations = std::max(1, options.inner_evaluations);
  const relax::LagrangianResult found =
      relax::maximize_dual(component, core::restrict_slots(from.component, u, component), loop, {});
  std::vector<double> component_u(u.begin(), u.end());
  if (!found.u.empty()) core::extend_slots(component, found.u, from.component, component_u);
  return {found.lower - inner.default_cost, of_part(from, component_u)};
}

}  // namespace nda::recovery
