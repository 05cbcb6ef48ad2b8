#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "bounded/lagrangian.hpp"
#include "core/clock.hpp"
#include "nda/options.hpp"
#include "nda/solution.hpp"

namespace nda::bounded {

/// What is known of a component with bounds.
struct BoundedState {
  Choice best;            ///< may pay the penalties of forbidden singletons
  std::vector<double> u;  ///< by slot: they prove `certificate`
  double certificate = -kInfinity;
  double lower = -kInfinity;          ///< proven bound, >= certificate
  bool complete = false;              ///< best is optimal to the margin
  const char* method = "relaxation";  ///< what solved it, or worked on it last
  Status stopped = Status::kOptimal;  ///< why work on it ended
  std::int64_t evaluations = 0;
  std::int64_t recoveries = 0;
  std::int64_t nodes = 0;
  std::size_t live_arcs = 0;  ///< Stats::arcs_after_fixing
  std::size_t left_arcs = 0;  ///< Stats::arcs_left
};

/// What is known of a component before it is solved; advice.
struct BoundedHint {
  std::vector<double> u;          ///< by slot; empty: nothing
  std::vector<core::ArcId> arcs;  ///< to be chosen greedily, first to last; may be empty
};

/// Solves one component with bounds in two stages, like its one-to-one counterpart.  Deterministic:
/// limits are counted in work; only the deadline looks at a clock.
class BoundedSolver {
 public:
  /// Told of every change of best and bound: by how much, and by what.
  using Moved = std::function<void(double cost_change, double bound_change, const char* event)>;

  /// Leaves everything alone; a bound that multipliers 0 prove.
  /// @param margin  a choice that is better at all is better by more than this
  BoundedSolver(const BoundedComponent& component,
                const Options& options,
                double margin,
                const core::Deadline& deadline,
                Moved moved);

  /// A choice that is known from elsewhere.
  void offer(const Choice& choice, const char* event);

  /// First stage: multipliers and a choice, by coordinate ascent and greedily, or by Lagrangian
  /// relaxation and recovery where that is all that is asked for, or where a linear program would
  /// be large; two dimensions exactly.
  void start(const BoundedHint& hint = {});

  /// Second stage, if not complete: linear programs and branching until the gap is at most
  /// `allowed_gap`, or a limit strikes.
  void finish(double allowed_gap);

  const BoundedState& state() const { return state_; }

 private:
  void approximate(const std::vector<double>& start);
  void ascend(std::span<const double> start, int sweeps);
  void assign();
  void relax(bool is_last);
  void maximize(const LagrangianOptions& loop);
  Choice recover(const RelaxedDual& point);
  Choice descend(std::span<const double> u, std::span<const core::ArcId> preferred) const;
  void branch(double allowed_gap);
  void accept(std::vector<double> u, const char* event);
  void raise(double lower, const char* event);
  bool is_closed() const { return state_.lower >= state_.best.cost - margin_; }
  void close();
  Status out_of_time() const;

  const BoundedComponent& component_;
  const Options& options_;
  const double margin_;
  const core::Deadline deadline_;
  const Moved moved_;
  BoundedState state_;
};

}  // namespace nda::bounded
