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
};

/// Settles components by reductions alone, one after the other, and counts what these did.
class Settler {
 public:
  /// Nothing where the component is too large to be tried, where arcs are left, or where the
  /// multipliers do not prove the packing to the precision of the component.  All its singletons
  /// must be free.
  std::optional<SettledComponent> settle(const core::Component& component,
                                         const core::CostGrid& grid,
                                         Reductions reductions);

  /// Adds to Stats::tried_components, settled_components and both reductions.
  void count(Stats& stats) const;

 private:
  std::optional<SettledComponent> try_to_settle(const core::Component& component,
                                                const core::CostGrid& grid,
                                                reduce::Effort effort);

  reduce::Reducer reducer_;
  std::size_t tried_ = 0;
  std::size_t settled_ = 0;
  ReductionYield useful_;
  ReductionYield forgotten_;
};

/// Tells the monitor of it.
void tell(const ComponentState& state, Monitor& monitor);

}  // namespace nda::pipeline
