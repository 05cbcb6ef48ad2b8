#pragma once

#include <memory>
#include <string>

#include "bounded/bounded_component.hpp"
#include "bounded/bounded_solver.hpp"
#include "core/clock.hpp"
#include "core/shift.hpp"
#include "nda/options.hpp"
#include "nda/solution.hpp"
#include "nda/warm_start.hpp"
#include "solve/component_solver.hpp"
#include "solve/monitor.hpp"

namespace nda::pipeline {

/// How exactly the costs of its choices are known.  Penalties do not count: bounds allow for what
/// they round off, and solutions pay none.
Precision precision_of_part(const bounded::BoundedComponent& component, const core::CostGrid& grid);

/// A part of a problem with bounds and its solver.
///
/// Forbidden singletons are priced: a best choice that pays no penalty is a best solution however
/// low the penalty.  Where the best one does pay, the fewest missing uses are searched for; if some
/// always are, the part is infeasible, else the solution that was found tells which penalty is
/// surely enough.
class BoundedPart {
 public:
  BoundedPart(bounded::BoundedComponent component,
              const Options& options,
              const core::CostGrid& grid,
              const core::Deadline& deadline,
              Monitor& monitor);

  void start(const WarmStart& warm);
  void finish(double allowed_gap);

  const bounded::BoundedComponent& component() const { return component_; }
  const bounded::BoundedState& state() const { return solver_->state(); }
  bool on_grid() const { return precision_.on_grid(); }
  /// By how much costs and bounds may be beside the truth.
  double error() const { return on_grid() ? precision_.error : precision_.margin; }
  /// No solution of the part costs less: on a grid a proof to less than a step is a proof of the
  /// cost.
  double lower_bound() const {
    return state().complete && on_grid() ? state().best.cost : state().lower;
  }
  /// The best choice pays no penalty.
  bool is_feasible() const { return is_feasible_; }
  /// There is no solution, and why.
  bool is_infeasible() const { return !reason_.empty(); }
  const std::string& reason() const { return reason_; }
  ComponentReport report() const;

 private:
  void make_solver();
  void moved(double cost_change, double bound_change, const char* event);
  void look();
  void seek_solution(double allowed_gap);
  std::string why_infeasible(const bounded::BoundedComponent& counting,
                             const bounded::BoundedState& state) const;

  bounded::BoundedComponent component_;
  const Options& options_;
  const core::CostGrid& grid_;
  const core::Deadline& deadline_;
  Monitor& monitor_;
  Precision precision_;
  std::unique_ptr<bounded::BoundedSolver> solver_;
  bool is_feasible_ = false;
  bool is_done_ = false;
  std::string reason_;
};

}  // namespace nda::pipeline
