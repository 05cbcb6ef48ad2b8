#pragma once

#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "bounded/cells.hpp"
#include "dual/concave_function.hpp"

namespace nda::bounded {

/// The Lagrangian dual of a component with its first m dimensions kept and the others relaxed
/// (report, sections 3.1 and 4.1, with bounds); what all m have in common.  For any u,
///
///     q(u) = sum over relaxed indices of min over 0 <= n <= hi of f(n) + u n
///          + the best choice of arcs at their reduced costs where only kept indices count (3.4)
///          + sum over the arcs of cell (0 .. 0) of min(0, r) (3.5)
///
/// is concave and q(u) <= optimum (Theorem 4.1).  A cell, the arcs that agree in all kept indices,
/// may be used as often as these: its cheapest arcs so many stand side by side, where the
/// one-to-one collapse of eq. (3.3) keeps the cheapest alone.  A subgradient is the number of uses
/// that attains the minimum, less the uses by chosen arcs (4.4).
///
/// Variables are the slots from dimension m on, dummies included (their value must be 0, their
/// subgradient is 0).
class RelaxedDual : public dual::ConcaveFunction {
 public:
  std::size_t num_variables() const override { return component_.rows.size() - first_slot_; }
  std::uint32_t first_slot() const { return first_slot_; }
  int num_kept() const { return cells_.num_kept; }
  const Cells& cells() const { return cells_; }

  /// Cost: O(A N) and what the kept dimensions take.
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  /// The arcs of the last relaxed solution, ascending: kept indices are used within their bounds.
  std::span<const core::ArcId> chosen_arcs() const { return chosen_; }
  /// The point of the last evaluation by slot, 0 for kept dimensions.
  std::span<const double> slot_values() const { return slot_u_; }
  /// Reduced costs of the last evaluation, kept dimensions left out.
  std::span<const double> reduced_costs() const { return r_; }

  /// What searches of the last evaluation prove of every choice, rounding taken off; -inf where
  /// there were none, or they had no time: what the multipliers prove is another matter.
  double bound() const;

  /// Multipliers of all slots at the last point; those of kept dimensions prove what they can.
  virtual void multipliers(std::span<double> all) const = 0;

 protected:
  /// Keeps a reference to the component.
  RelaxedDual(const BoundedComponent& component, int num_kept);

  /// What the kept dimensions are said to cost, uses that they lack included, and what is proven to
  /// be the least; -inf: nothing is.
  struct KeptValue {
    double value = 0;
    double lower = 0;
  };
  /// Chooses among the offered arcs, at reduced costs, such that no kept bound is exceeded; appends
  /// them to `chosen`.  Offered are the cheapest arcs of each cell, cell after cell, those of no
  /// use left out.
  virtual KeptValue solve_kept(std::span<const core::ArcId> offered,
                               std::vector<core::ArcId>& chosen) = 0;

  const BoundedComponent& component() const { return component_; }
  /// What these arcs cost at the last point, and what the kept indices then lack.
  double kept_cost(std::span<const core::ArcId> arcs) const;

 private:
  void collapse();
  double take_free_arcs();

  const BoundedComponent& component_;
  const Cells cells_;
  std::uint32_t first_slot_ = 0;
  std::vector<double> slot_u_;
  std::vector<double> r_;  // [arc]
  std::vector<core::ArcId> offered_;
  std::vector<core::ArcId> of_cell_;
  std::vector<core::ArcId> chosen_;
  double value_ = 0;
  double kept_gap_ = 0;  // how much less the kept dimensions may cost than value_ says
};

}  // namespace nda::bounded
