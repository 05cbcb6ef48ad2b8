#pragma once

#include <optional>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "nda/options.hpp"
#include "nda/solution.hpp"
#include "reduce/reducer.hpp"
#include "solve/component_solver.hpp"
#include "solve/monitor.hpp"

namespace nda::pipeline {

/// A component that reductions solved alone.
struct SettledComponent {
  ComponentState state;
  Precision precision;
  ReductionYield yield;
};

/// Nothing where the component is too large to be tried, where arcs are left, or where the
/// multipliers do not prove the packing to the precision of the component.  All its singletons must
/// be free.
std::optional<SettledComponent> settle(const core::Component& component,
                                       const core::CostGrid& grid,
                                       Reductions reductions,
                                       reduce::Reducer& reducer);

/// Tells the monitor of it.
void tell(const ComponentState& state, Monitor& monitor);

}  // namespace nda::pipeline
