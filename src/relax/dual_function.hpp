#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "dual/concave_function.hpp"
#include "nda/assign2d.hpp"
#include "nda/options.hpp"
#include "relax/collapse.hpp"

namespace nda::relax {

/// The Lagrangian dual of a component with dimensions 2..N-1 relaxed and 0 and 1 kept (m = 2).
///
/// In shifted form every index has a singleton of cost 0; those of relaxed indices are relaxed with
/// them.  For any u (no sign!), with d the collapse of eq. (3.3),
///
///     q(u) = sum over relaxed i of min(0, u_i)                   each index pays u_i, its
///     singleton asks 0 - u_i
///          + least-cost assignment of d, rows and columns free to stay out at min(0, d(i1, 0)),
///          min(0, d(0, i2))
///          + sum over arcs of cell (0, 0) of min(0, c' - sum u)  every one of them may be used
///          (3.5)
///
/// is concave and q(u) <= optimum (Theorem 4.1).  A subgradient counts uses, eq. (4.4):
/// g_i = 1 - (number of chosen arcs and singletons that use i).
///
/// Variables are the slots from dimension 2 on, dummies included (their value must be 0, their g is
/// 0). A component of two dimensions has no variables, and q() is its optimum.
class DualFunction : public dual::ConcaveFunction {
 public:
  /// Keeps a reference to the component.
  explicit DualFunction(const core::Component& component,
                        Assign2dMethod method = Assign2dMethod::kShortestPath,
                        const core::Deadline& deadline = {});
  ~DualFunction() override;

  std::size_t num_variables() const override { return num_slots_ - first_slot_; }

  /// Cost: O(A N) + one two-dimensional assignment, warm-started; no allocation after the first
  /// call.
  double evaluate(std::span<const double> u, std::span<double> subgradient) override;

  /// The deadline broke the last evaluation off.  Value and subgradient are then of no use; the
  /// chosen arcs still use dimensions 0 and 1 at most once, and the multipliers are still
  /// multipliers.
  bool interrupted() const { return interrupted_; }

  /// First relaxed slot: variable j stands for slot first_slot() + j.
  std::uint32_t first_slot() const { return first_slot_; }

  /// The arcs of the last relaxed solution w (3.5): of the assignment, of rows and columns that
  /// stay out, and of cell (0, 0).  Dimensions 0 and 1 are used at most once, the others perhaps
  /// more often.
  std::span<const core::ArcId> chosen_arcs() const { return chosen_; }

  /// The index alignment of the last evaluation: the cells of chosen_arcs() but for the free ones.
  std::span<const std::uint32_t> aligned_cells() const { return aligned_cells_; }
  /// |g|^2 of the last evaluation: 0 where the relaxed solution is feasible.
  double violation() const { return violation_; }
  const Cells& cells() const { return cells_; }

  /// The two-dimensional problem of the last evaluation, until the next one or the end of this.
  Assign2dProblem assignment() const;
  /// The alignment that an answer to assignment() is.
  std::vector<std::uint32_t> cells_of(const Assign2dResult& answer) const;

  /// Multipliers of all slots at the last evaluated u: the assignment's duals for dimensions 0 and
  /// 1, min(0, u) for the others.  They prove q(u) up to the arcs of cell (0, 0): see
  /// make_feasible().
  void multipliers(std::span<double> all) const;

 private:
  struct Assignment;

  template <typename Visit>
  void for_each_chosen_cell(const Assign2dResult& answer, Visit&& visit) const;
  void choose(std::span<double> subgradient);
  void take_cell(std::uint32_t cell, std::span<double> subgradient);
  double take_free_arcs(std::span<double> subgradient);
  void use(core::ArcId a, std::span<double> subgradient);

  const core::Component& component_;
  Cells cells_;
  std::uint32_t first_slot_ = 0;
  std::size_t num_slots_ = 0;
  std::vector<double> slot_u_;          // multipliers by slot, as collapse() wants them
  std::vector<double> d_;               // [cell]
  std::vector<core::ArcId> cell_from_;  // [cell]: where collapse() says that its arc is
  std::vector<core::ArcId> chosen_;
  std::vector<std::uint32_t> aligned_cells_;
  std::unique_ptr<Assignment> assignment_;
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
