#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "cutting/cut.hpp"
#include "lp/linear_program.hpp"

namespace nda::cutting {

/// The linear relaxation of a component with cuts, exact, by column generation:
///
///     minimise c' x   so that   every index is used at most once, every cut holds, x >= 0.
///
/// Only arcs that matter are in the linear program; the others are priced with its multipliers and
/// enter when their reduced cost is negative.  Rows are slots, then cuts.
///
/// *Live* arcs are those that may still be used; forget() drops the others for good, forbid() for a
/// while (branching).  All statements are about packings of live arcs that are not forbidden.
class Master {
 public:
  /// Starts with the arcs that `u` (by slot) makes cheapest.
  Master(const core::Component& component,
         std::vector<core::ArcId> live,
         std::span<const double> u);

  /// Solves to optimality over all live arcs.  Stops early once lower() is proven to reach
  /// `cutoff`.  lower(), u() and reduced_cost() hold after kOptimal and kCutoff only.
  lp::Outcome solve(double cutoff, const core::Deadline& deadline);

  /// What it relaxes.
  const core::Component& component() const { return component_; }

  /// Lower bound: sum u + sum over cuts of multiplier * right side + sum over arcs of min(0, r).
  double lower() const { return lower_; }
  std::span<const double> u() const { return u_; }
  const std::vector<CutRow>& cuts() const { return cuts_; }
  double reduced_cost(core::ArcId a) const { return reduced_[a]; }
  std::span<const core::ArcId> live() const { return live_; }

  /// The arcs of the linear program, and their values in its last solution.
  std::span<const core::ArcId> arcs() const { return column_arc_; }
  std::span<const double> values() const { return program_.primal().subspan(u_.size()); }

  void add(const Cut& cut);
  /// Removes cuts whose multiplier was 0 in the last `most_idle` solves, but for those that hold
  /// without slack all the same.
  void drop_idle(int most_idle);
  /// Drops live arcs whose reduced cost shows that no packing below `cutoff` uses them; returns
  /// whether there were any.
  bool fix(double cutoff);

  /// Forbids arcs until they are allowed again as often.
  void forbid(std::span<const core::ArcId> arcs);
  void allow(std::span<const core::ArcId> arcs);
  bool forbidden(core::ArcId a) const { return forbidden_[a] > 0; }
  /// Demands that a slot be covered, until it is released as often.  Leaving it uncovered then has
  /// a price, so that the linear program stays feasible.
  void force(std::uint32_t slot);
  void release(std::uint32_t slot);
  bool forced(std::uint32_t slot) const { return forced_[slot] > 0; }

  /// Values of lower() for which a trial of branching is enough: few dual simplex steps.
  double trial(int max_iterations, const core::Deadline& deadline);
  std::vector<unsigned char> basis() { return program_.basis(); }
  void set_basis(const std::vector<unsigned char>& basis) { program_.set_basis(basis); }
  const SlotIndex& index() const { return index_; }

  std::int64_t simplex_iterations() const { return program_.iterations(); }

 private:
  void insert(std::span<const core::ArcId> arcs);
  void take_multipliers();
  void price();
  std::vector<core::ArcId> entering() const;
  void rebuild_index();

  const core::Component& component_;
  std::vector<core::ArcId> live_;
  SlotIndex index_;
  std::size_t index_arcs_ = 0;  // live arcs when index_ was made
  CutLister lister_;
  lp::LinearProgram program_;
  // Columns: per slot what leaving it uncovered costs where that is not allowed, then arcs.
  std::vector<core::ArcId> column_arc_;
  std::vector<int> column_of_;            // [arc], -1 = not in the program
  std::vector<std::uint16_t> forbidden_;  // [arc]: how often
  std::vector<int> forced_;               // [slot]: how often
  std::vector<CutRow> cuts_;
  std::vector<double> u_;        // [slot]
  std::vector<double> reduced_;  // [arc], of live ones
  double scale_ = 1;             // costs in the program are so many times those of the component
  double lower_ = -kInfinity;
  bool dual_feasible_ = false;  // rows were added or bounds changed since the last solve
};

}  // namespace nda::cutting
