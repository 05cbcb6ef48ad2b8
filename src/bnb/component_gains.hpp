#pragma once

#include <span>
#include <vector>

#include "bnb/clique_search.hpp"
#include "core/component.hpp"

namespace nda::bnb {

/// What arcs of a component gain over multipliers: a packing of these arcs costs no less than
///
///     base - sum over its arcs of gain,
///
/// and no more if it covers all slots with u > 0.
struct ComponentGains {
  CliqueProblem problem;
  std::vector<core::ArcId> arcs;  ///< [arc of the problem]; those that gain nothing are left out
  double base = 0;                ///< sum of u
};

/// @param arcs  those that may be used, ascending.
/// @param u     by slot, >= 0; 0 for slots that may stay uncovered.
ComponentGains gains_over(const core::Component& component,
                          std::span<const core::ArcId> arcs,
                          std::span<const double> u);

}  // namespace nda::bnb
