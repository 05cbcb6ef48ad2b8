#include "bounded/kept_dual.hpp"

#include <algorithm>
#include <utility>

#include "bounded/parts.hpp"

// The cheapest arcs of every cell are the arcs of the relaxed problem.  Several of a cell have the
// same indices there, and nothing forbids that: none is used more than once.

namespace nda::bounded {

using core::ArcId;

KeptDual::KeptDual(const BoundedComponent& component, int num_kept, KeptSolver solve, bool merit)
    : RelaxedDual(component, num_kept), solve_(std::move(solve)), merit_(merit) {}

RelaxedDual::KeptValue KeptDual::solve_kept(std::span<const ArcId> offered,
                                            std::vector<ArcId>& chosen) {
  const core::Component& graph = component().graph;
  const auto kept = static_cast<std::ptrdiff_t>(num_kept());
  problem_.graph = core::make_component({graph.sizes.begin(), graph.sizes.begin() + kept});
  problem_.rows.assign(component().rows.begin(),
                       component().rows.begin() + static_cast<std::ptrdiff_t>(first_slot()));
  std::vector<Index> tuple(static_cast<std::size_t>(kept));
  for (const ArcId a : offered) {
    for (int k = 0; k < num_kept(); ++k) tuple[static_cast<std::size_t>(k)] = graph.index(k, a);
    core::append_arc(problem_.graph, tuple, reduced_costs()[a]);
  }
  fit_rows(problem_);
  solve_(problem_, answer_);
  for (const ArcId a : answer_.best.arcs) chosen.push_back(offered[a]);
  const bool is_bounded = answer_.lower > -kInfinity;
  const bool guides = is_bounded && merit_ && !answer_.exact;
  return {guides ? answer_.lower : kept_cost(chosen), answer_.lower};
}

void KeptDual::multipliers(std::span<double> all) const {
  std::copy(slot_values().begin(), slot_values().end(), all.begin());
  std::copy(answer_.u.begin(), answer_.u.end(), all.begin());
}

}  // namespace nda::bounded
