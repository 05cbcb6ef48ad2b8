#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bnb/branch_and_bound.hpp"
#include "bnb/proof_log.hpp"
#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/for_all.hpp"
#include "core/shift.hpp"
#include "cutting/master.hpp"
#include "cutting/widening.hpp"
#include "nda/options.hpp"
#include "nda/solution.hpp"
#include "recovery/dimensionwise_search.hpp"
#include "relax/lagrangian.hpp"
#include "rows/cut_rounds.hpp"
#include "solve/monitor.hpp"

namespace nda::pipeline {

/// Tells equal costs from different ones within a component (docs/numerics.md).
struct Precision {
  double error = 0;   ///< rounding: costs that differ by less may be equal
  double margin = 0;  ///< a packing that is better at all is better by more than this; >= error

  /// The costs lie on a grid so coarse that rounding hides no difference.
  bool on_grid() const { return margin > error; }
  /// By more than this packings differ that do not cost the same; 0 off a grid.
  double step() const { return on_grid() ? margin : 0; }
};

/// error = 2^-50 * indices * largest |c'|, a bound on what any sum of costs or multipliers of the
/// component rounds off; where costs lie on a grid that coarse, margin = step - 4 of the same by
/// the largest |c| of the problem, if that is larger and leaves a grid, else error.
Precision precision_of(const core::Component& component, const core::CostGrid& grid);
/// The same of any costs.
Precision precision_of(std::size_t num_indices, double largest, const core::CostGrid& grid);

/// What is known of a component.
struct ComponentState {
  core::Packing best;                 ///< in arcs of the component
  std::vector<double> u;              ///< feasible multipliers by slot: the certificate
  double certificate = 0;             ///< sum u
  double lower = 0;                   ///< proven bound, >= certificate where branching helped
  bool complete = false;              ///< best is optimal to precision.error, or none is feasible
  bool feasible = false;              ///< best leaves no required slot uncovered
  const char* method = "";            ///< what solved it, or worked on it last
  Status stopped = Status::kOptimal;  ///< why work on it ended; set by finish()
  std::int64_t evaluations = 0;
  std::int64_t recoveries = 0;
  std::int64_t nodes = 0;
  std::size_t live_arcs = 0;  ///< Stats::arcs_after_fixing
  std::size_t left_arcs = 0;  ///< Stats::arcs_left
  FixingYield branching;
  FixingYield searches;
};

/// What a warm start knows of a component; nothing where empty.
struct Hint {
  std::vector<double> u;  ///< by slot, <= 0
  core::Packing best;     ///< in arcs of the component
};

/// Solves one component in two stages, so that all components get a solution and a bound before any
/// is worked on for long.  Deterministic: limits are counted in work; only the deadline looks at a
/// clock.
class ComponentSolver {
 public:
  /// @param required  by slot: whether its singleton is forbidden; empty where none of the problem
  ///                  is.
  /// @param hint      where to start from.
  /// @param proof     where to write down why the bound holds; may be null.
  ComponentSolver(const core::Component& component,
                  std::vector<bool> required,
                  const Hint& hint,
                  const Options& options,
                  const core::CostGrid& grid,
                  std::uint64_t seed,
                  const core::Deadline& deadline,
                  Monitor& monitor,
                  bnb::ProofLog* proof);

  /// A bound was found before the deadline.  Without one, state().u are multipliers that prove
  /// little, and neither stage must be begun.
  bool bounded() const { return state_.certificate > -kInfinity; }

  /// First stage: exact where that is quick, else relaxation with recovery and local search.
  void start();

  /// Second stage, if not complete: local search, fixing and branching until the gap of a feasible
  /// packing is at most `allowed_gap` (absolute), or a limit strikes.
  void finish(double allowed_gap);

  /// Completes the proof of the component; last.
  void finish_proof();

  const ComponentState& state() const { return state_; }
  const Precision& precision() const { return precision_; }

 private:
  relax::LagrangianOptions loop_options(const core::Component& component) const;
  void solve_assignment();
  void enumerate();
  void ascend();
  void search_nearly_free();
  void search_near_hint();
  void search_near_multipliers();
  void search_gap(bnb::SlackLimits limits, const char* event);
  void note_left(std::size_t arcs) { state_.left_arcs = std::min(state_.left_arcs, arcs); }
  void search_cliques();
  void settle_best();
  void relax();
  bool may_search() const;
  double first_work() const;
  double wide_work() const;
  void improve(const core::Component& core,
               std::span<const core::ArcId> live,
               cutting::Master& point,
               const cutting::PrimalBudget& budget);
  std::vector<core::Packing> dive(const core::Component& core,
                                  std::span<const core::ArcId> live,
                                  cutting::Master& point,
                                  double work);
  void search_by_master(const core::Component& core,
                        std::span<const core::ArcId> live,
                        const cutting::Master& point,
                        const std::vector<core::Packing>& others,
                        double work,
                        double swap_work);
  double swap_work(double work);
  void search(double work);
  void reassign(double work);
  bool is_wide() const;
  bool is_large() const;
  std::vector<core::ArcId> live_arcs() const;
  void accept_dual(relax::LagrangianResult result, const char* event);
  void accept_multipliers(std::vector<double> u, double certificate, const char* event);
  void branch_and_cut();
  void adopt_multipliers(const core::Component& core, std::span<const double> core_u);
  bool wants_averaged_cuts(const core::Component& core) const;
  rows::CutRoundsResult cut_on_averages(const core::Component& core, double margin);
  double search_circles(const core::Component& core,
                        std::span<const core::ArcId> live,
                        cutting::WideningLimits& limits);
  core::Packing round(const core::Component& core,
                      std::span<const core::ArcId> arcs,
                      std::span<const double> values,
                      std::span<const double> u) const;
  void branch();
  bnb::NodeBound bound_node(const core::Component& node,
                            std::span<const double> warm,
                            double cutoff);
  bnb::BranchLimits branch_limits() const;
  void take_tree(const bnb::SearchResult& result);
  void close_gap();
  Status reason_to_stop() const;
  bool covers_required(const core::Packing& packing) const;
  bool offer(const core::Packing& packing, const char* event);
  void accept(const core::Packing& packing, const char* event);
  void raise_bound(double lower, const char* event);
  bool close_enough() const;
  double search_goal() const;
  double cutoff() const { return state_.best.cost - precision_.margin; }

  const core::Component& component_;
  const std::vector<bool> required_;
  const Options& options_;
  const core::Deadline& deadline_;
  const core::ForAll for_all_;
  Monitor& monitor_;
  const Precision precision_;
  // Above this the linear program would be too large to be of use, and memory runs out.
  static constexpr std::size_t kMostCuttingArcs = 2000000;
  static constexpr double kLeastSwapWork = 2e7;
  static constexpr double kLeastSwapWorkPerArc = 2e4;

  const std::uint64_t seed_;
  bnb::ProofLog* const proof_;
  const bool is_hot_;
  bool enumerated_ = false;
  bool tried_cliques_ = false;
  bool searched_cliques_ = false;  // to the end
  bool searched_ = false;
  bool out_of_time_ = false;              // the last relaxation stopped before the deadline
  double searched_free_at_ = -kInfinity;  // the certificate then
  double next_wide_search_ = 0;           // 0 = there was none yet
  int improvements_ = 0;
  const double least_swap_work_ =
      std::min(kLeastSwapWork, kLeastSwapWorkPerArc* static_cast<double>(component_.num_arcs()));
  double swap_credit_ = least_swap_work_;  // the first search by swaps is not too late
  double certify_s_ = 0;                   // what making multipliers feasible took
  double allowed_gap_ = 0;                 // absolute, that ends the second stage
  double dearest_ = 0;  // if any packing covers all required slots, one costs no more
  std::optional<recovery::DimensionwiseSearch> dimensionwise_;
  ComponentState state_;
};

}  // namespace nda::pipeline
