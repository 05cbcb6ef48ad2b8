#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "core/clock.hpp"
#include "nda/problem.hpp"

namespace nda::bounded {

/// A problem with bounds in parts that have nothing to do with one another.
///
/// An arc that costs no less than its uses can save is in no part.  An index whose bounds cannot
/// bind pays or asks the same for every use: its arcs are charged for it, which couples nothing.
/// So some optimal solution consists of `taken`, an optimal choice of every part, and an optimal
/// solution of the rest, in which every index is to be used once.
struct Split {
  std::string infeasible;  ///< why, where an index has fewer arcs than it must have uses
  std::vector<std::vector<double>> charge;  ///< [k][i]: multiplier of what is in neither
  double constant = 0;             ///< cost of what is in neither, with nothing but `taken` chosen
  std::vector<core::ArcId> taken;  ///< arcs that couple nothing and pay
  std::vector<double> taken_cost;  ///< what each adds to the cost
  std::vector<BoundedComponent> parts;  ///< indices with penalties in place of forbidden singletons

  /// What remains, numbered as the problem.  Indices of its own have their singleton costs, all
  /// others have cost 0 and no arc.
  std::optional<Problem> rest;
  std::vector<std::vector<std::uint8_t>> in_rest;  ///< [k][i]: an index of the rest's own
  std::vector<core::ArcId> rest_arc;               ///< [arc of the rest]: arc of the problem
  /// [k][i]: the arc that stands for leaving the index alone; kNoArc: its singleton does.
  std::vector<std::vector<core::ArcId>> alone;

  static constexpr core::ArcId kNoArc = ~core::ArcId{0};
};

/// Splits.  `infeasible` is set and nothing else of use where the reason is found.  Cost:
/// O(A N log A).  Without parts and rest where the deadline strikes.
Split split(const Problem& problem, const core::Deadline& deadline);

/// All indices of a problem with these arcs alone, ascending, as one component, with penalties in
/// place of forbidden singletons.  Nothing is left out that cannot improve: for second bests.
BoundedComponent whole_component(const Problem& problem, std::span<const core::ArcId> arcs);

/// A penalty for each missing use of an index whose singleton is forbidden: 16 (N + 1) times the
/// largest |c'| or singleton, which is nearly always enough.
void set_modest_penalties(BoundedComponent& component);

/// The same with a penalty that is surely enough where a solution costs so much: whatever misses a
/// use costs more.
void set_penalties_above(BoundedComponent& component, double cost);

/// Largest |c'| and |single| of the component, penalties apart.
double largest_cost(const BoundedComponent& component);

}  // namespace nda::bounded
