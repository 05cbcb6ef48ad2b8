#include "solve/settling.hpp"

#include <algorithm>
#include <utility>

// Reductions either settle a component or are forgotten.  What they leave could be solved in place
// of the component, but a proof that branches is about the arcs of the problem: where branching
// forbids an arc, what it dominated comes back.  And most of what reductions remove from large
// components is removed by reduced costs for less (docs/reductions.md).

namespace nda::pipeline {
namespace {

// Some tenths of a millisecond, so that nobody need look at the clock meanwhile.
constexpr std::size_t kMostSettledArcs = 20000;

}  // namespace

std::optional<SettledComponent> Settler::settle(const core::Component& component,
                                                const core::CostGrid& grid,
                                                Reductions reductions) {
  if (reductions == Reductions::kNone) return std::nullopt;
  if (component.num_arcs() > kMostSettledArcs) return std::nullopt;
  std::optional<SettledComponent> settled =
      try_to_settle(component,
                    grid,
                    reductions == Reductions::kAll ? reduce::Effort::kAll : reduce::Effort::kQuick);
  ++tried_;
  settled_ += settled.has_value();
  (settled ? useful_ : forgotten_) += reducer_.yield();
  return settled;
}

void Settler::count(Stats& stats) const {
  stats.tried_components += tried_;
  stats.settled_components += settled_;
  stats.reductions += useful_;
  stats.forgotten_reductions += forgotten_;
}

std::optional<SettledComponent> Settler::try_to_settle(const core::Component& component,
                                                       const core::CostGrid& grid,
                                                       reduce::Effort effort) {
  std::optional<reduce::Settled> found = reducer_.settle(component, effort);
  if (!found) return std::nullopt;
  SettledComponent settled{{}, precision_of(component, grid)};
  if (found->best.cost - found->certificate > settled.precision.error) return std::nullopt;
  ComponentState& state = settled.state;
  state.best = std::move(found->best);
  state.u = std::move(found->u);
  state.certificate = found->certificate;
  state.lower = std::max(state.certificate, state.best.cost - settled.precision.error);
  state.complete = state.feasible = true;
  state.method = "reductions";
  state.live_arcs = state.left_arcs = component.num_arcs();
  return settled;
}

void tell(const ComponentState& state, Monitor& monitor) {
  monitor.add_component(state.lower);
  monitor.component_done();
  monitor.moved(state.best.cost, 0, "reductions");
}

}  // namespace nda::pipeline
