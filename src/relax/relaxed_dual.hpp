#pragma once

#include <span>
#include <vector>

#include "core/component.hpp"
#include "dual/concave_function.hpp"
#include "relax/collapse.hpp"

namespace nda::relax {

/// The Lagrangian dual of a component with its first m dimensions kept and the others relaxed, for
/// any m from 0 to N - 1 (docs/relaxations.md); what all m have in common.
///
/// In shifted form every index has a singleton of cost 0; those of relaxed indices are relaxed with
/// them.  For any u (no sign!), with d the collapse of eq. (3.3),
///
///     q(u) = sum over relaxed i of min(0, u_i)                   each index pays u_i, its
///     singleton asks 0 - u_i
///          + cost of the best packing of the kept indices by cells, at cost d
///          + sum over arcs of cell (0 .. 0) of min(0, c' - sum u)  every one of them may be used
///          (3.5)
///
/// is concave and q(u) <= optimum (Theorem 4.1).  A subgradient counts uses, eq. (4.4):
/// g_i = 1 - (number of chosen arcs and singletons that use i).
///
/// Variables are the slots from dimension m on, dummies included (their value must be 0, their g is
/// 0).
class RelaxedDual : public dual::ConcaveFunction {
 public:
  std::size_t num_variables() const override { return slot_u_.size() - first_slot_; }

  /// Cost: O(A N) + what the kept sets take.
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  /// m.
  int num_kept() const { return cells_.num_kept; }
  /// First relaxed slot: variable j stands for slot first_slot() + j.
  std::uint32_t first_slot() const { return first_slot_; }
  /// The point of the last evaluation by slot; 0 for those of kept dimensions.
  std::span<const double> slot_values() const { return slot_u_; }

  /// The deadline broke the last evaluation off.  Value and subgradient are then of no use; the
  /// chosen arcs still use kept dimensions at most once, and the multipliers are still multipliers.
  bool interrupted() const { return interrupted_; }

  /// A lower bound on every packing, as the last evaluation proves it, rounding included.  Not far
  /// below the value, but where the kept sets were not packed at their best: there the value may be
  /// a guide alone.
  double bound() const;

  /// The arcs of the last relaxed solution w (3.5): those of the chosen cells, and of cell
  /// (0 .. 0).  Kept dimensions are used at most once, the others perhaps more often.
  std::span<const core::ArcId> chosen_arcs() const { return chosen_; }
  /// The index alignment of the last evaluation: the cells of chosen_arcs() but for the free ones.
  std::span<const std::uint32_t> aligned_cells() const { return aligned_cells_; }
  /// |g|^2 of the last evaluation: 0 where the relaxed solution is feasible.
  double violation() const { return violation_; }
  const Cells& cells() const { return cells_; }

  /// Multipliers of all slots at the last evaluated u: min(0, u) for relaxed dimensions, for kept
  /// ones what pays for their cells.  They prove q(u) for m <= 2, and for more what the kept
  /// problem's own multipliers do, up to the arcs of cell (0 .. 0): see make_feasible().
  void multipliers(std::span<double> all) const;

 protected:
  /// Keeps a reference to the component.
  RelaxedDual(const core::Component& component, int num_kept);

  /// What a packing of the kept indices by cells is said to cost, and what it costs at least.
  struct KeptValue {
    double value = 0;
    double lower = 0;
    bool interrupted = false;
  };
  /// Packs the kept indices: cell costs[cell] (3.4).  Appends the cells taken to `chosen`.
  virtual KeptValue solve_kept(std::span<const double> costs,
                               std::vector<std::uint32_t>& chosen) = 0;
  /// Writes the multipliers of the real indices of kept dimensions.
  virtual void kept_multipliers(std::span<double> all) const = 0;

  const core::Component& component() const { return component_; }

 private:
  double take_free_arcs(std::span<double> subgradient);
  void use(core::ArcId a, std::span<double> subgradient);

  const core::Component& component_;
  const Cells cells_;
  std::uint32_t first_slot_ = 0;
  double largest_cost_ = 0;             // |c'|
  std::vector<double> slot_u_;          // multipliers by slot, as collapse() wants them
  std::vector<double> d_;               // [cell]
  std::vector<core::ArcId> cell_from_;  // [cell]: where collapse() says that its arc is
  std::vector<core::ArcId> chosen_;
  std::vector<std::uint32_t> aligned_cells_;
  double value_ = 0;
  double kept_gap_ = 0;  // how much less the kept indices may cost than value_ says
  double violation_ = 0;
  bool interrupted_ = false;
};

/// Makes multipliers dual feasible without lowering their bound: afterwards u <= 0, the dummies'
/// are 0, every reduced cost c'[a] - sum u is >= 0 (up to rounding), and sum u is a lower bound.
/// One pass of coordinate ascent over the dimensions, the last first: u_i takes up the least
/// reduced cost of its arcs, which repairs negative ones (cell (0, 0), a well-known trap) and uses
/// slack. Returns sum u, or -inf where the deadline strikes: u is then better than it was, but not
/// feasible.  Cost: O(A N^2).
double make_feasible(const core::Component& component,
                     std::span<double> u,
                     const core::Deadline& deadline = {});

}  // namespace nda::relax
