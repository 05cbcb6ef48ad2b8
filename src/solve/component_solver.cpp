#include "solve/component_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/double_double.hpp"
#include "core/permuted.hpp"
#include "core/random.hpp"
#include "core/reduced_costs.hpp"
#include "cutting/leaf_search.hpp"
#include "recovery/core_search.hpp"
#include "recovery/greedy.hpp"
#include "recovery/kept_solver.hpp"
#include "recovery/recovery.hpp"
#include "recovery/recursive.hpp"
#include "relax/lagrangian.hpp"
#include "relax/set_order.hpp"
#include "solve/parallel.hpp"

// The order of work on one component follows what was measured (docs/pipeline.md): enumerate the
// small ones; relax to two dimensions, recovering on the way; improve the best packing; drop what
// reduced costs exclude; branch on what is left, with the same relaxation as bound in every node.

namespace nda::pipeline {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

// What more evaluations and recoveries would find, a linear program and a search by its multipliers
// find sooner.
constexpr int kEvaluationsBeforeLp = 50;
// Linear programs over many indices take so long that multipliers of their own are worth more.
constexpr int kIndicesPerEvaluation = 25;
// A recovery takes as long as dozens of evaluations of many arcs in one component.
constexpr int kLargeInterval = 100;
// Of the dimensionwise search of a component too large for an early linear program.
constexpr double kReassigningPerArc = 200;
// Time kept for the last certificate, as a multiple of what the first took.
constexpr double kCertifyReserve = 1.3;

// If any packing covers all required slots, one does that costs no more: it has no other arcs, and
// the required slots of an arc share its cost.  In double-double, since a bound that rounding lifts
// above it would prove that there is none.
double dearest_covering(const Component& component, const std::vector<bool>& required) {
  std::vector<double> share(component.num_slots(), -kInfinity);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    int count = 0;
    core::for_each_slot(component, a, [&](std::uint32_t slot) { count += required[slot]; });
    core::for_each_slot(component, a, [&](std::uint32_t slot) {
      share[slot] = std::max(share[slot], component.costs[a] / std::max(1, count));
    });
  }
  core::DoubleDouble total;
  for (std::size_t slot = 0; slot < share.size(); ++slot) {
    if (!required[slot]) continue;
    if (share[slot] == -kInfinity) return -kInfinity;
    total.add(share[slot]);
  }
  return total.high();
}

}  // namespace

Precision precision_of(const Component& component, const core::CostGrid& grid) {
  return precision_of(component.num_indices(), core::largest_cost(component), grid);
}

Precision precision_of(std::size_t num_indices, double largest, const core::CostGrid& grid) {
  Precision precision;
  precision.error = 0x1p-50 * static_cast<double>(num_indices) * largest;
  const auto margin = [&](double error) {
    return grid.step > 16 * error ? grid.step - 4 * error : precision.error;
  };
  // Where a bound is rounded up, costs before the shift are what is rounded.  Only proofs need that
  // on an exact grid, which is not to be lost for them.
  precision.margin =
      margin(0x1p-50 * static_cast<double>(num_indices) * std::max(largest, grid.largest));
  if (grid.exact && precision.margin == precision.error) precision.margin = margin(precision.error);
  return precision;
}

ComponentSolver::ComponentSolver(const Component& component,
                                 std::vector<bool> required,
                                 const Hint& hint,
                                 const Options& options,
                                 const core::CostGrid& grid,
                                 std::uint64_t seed,
                                 const core::Deadline& deadline,
                                 Monitor& monitor,
                                 bnb::ProofLog* proof)
    : component_(component),
      required_(std::move(required)),
      options_(options),
      deadline_(deadline),
      for_all_([&options](std::size_t count, const std::function<void(std::size_t)>& work) {
        pipeline::for_all(count, options.num_threads, [&](std::size_t i, std::size_t) { work(i); });
      }),
      monitor_(monitor),
      precision_(precision_of(component, grid)),
      seed_(seed),
      proof_(proof),
      is_hot_(!hint.u.empty()) {
  state_.live_arcs = state_.left_arcs = component.num_arcs();
  state_.u = hint.u;
  state_.u.resize(component.num_slots(), 0.0);
  const core::Stopwatch watch;
  state_.certificate = state_.lower = relax::make_feasible(component, state_.u, deadline);
  certify_s_ = kCertifyReserve * watch.seconds();
  if (bounded()) monitor_.add_component(state_.lower);
  state_.feasible = covers_required({});
  if (state_.feasible && !required_.empty()) monitor_.component_feasible();
  if (!state_.feasible) dearest_ = dearest_covering(component, required_);
  if (is_hot_ && bounded()) offer(hint.best, "warm start");
}

relax::LagrangianOptions ComponentSolver::loop_options(const Component& component) const {
  relax::LagrangianOptions loop = relax::loop_options(options_.relaxation, deadline_);
  loop.relative_tolerance = options_.relaxation.relative_tolerance;
  loop.certify_s = certify_s_ * static_cast<double>(component.num_arcs()) /
                   static_cast<double>(component_.num_arcs());
  return loop;
}

void ComponentSolver::start() {
  if (deadline_.reached() || state_.complete) return;
  if (component_.num_dimensions() == 2) return solve_assignment();
  if (options_.method == Method::kRelaxation) return relax();
  const bool small =
      component_.num_arcs() <= options_.branch.exact_arcs || options_.method == Method::kExact;
  if (small && options_.branch.max_nodes > 0) enumerate();
  if (state_.complete) return;
  if (is_hot_) {
    search_near_hint();
  } else {
    offer(recovery::greedy_in_core(
              component_, state_.u, recovery::CoreSearchOptions{}.arcs_per_index, deadline_),
          "greedy");
  }
  if (state_.complete) return;
  relax();
  if (!is_large()) return;
  reassign(kReassigningPerArc * static_cast<double>(component_.num_arcs()));
  search(first_work());
}

// Too large for branch and cut to end it at once; otherwise better packings can wait.
bool ComponentSolver::is_large() const {
  return component_.num_arcs() > cutting::kMostLeafArcs &&
         live_arcs().size() > cutting::kMostLeafArcs;
}

// Those that reduced costs leave.
std::vector<ArcId> ComponentSolver::live_arcs() const {
  std::vector<ArcId> live;
  core::for_each_reduced_cost(component_, state_.u, {}, [&](ArcId a, double r) {
    if (state_.certificate + r < cutoff()) live.push_back(a);
  });
  return live;
}

void ComponentSolver::finish(double allowed_gap) {
  // What the penalties of uncovered indices cost is no gap that anyone asked for.
  allowed_gap_ = state_.feasible ? allowed_gap : 0;
  if (options_.method != Method::kRelaxation) close_gap();
  state_.stopped = reason_to_stop();
}

void ComponentSolver::close_gap() {
  if (close_enough() || deadline_.reached()) return;
  if (options_.method == Method::kExact && is_wide()) search(wide_work());
  if (options_.method != Method::kExact) {
    search_nearly_free();
    if (!close_enough()) search_near_multipliers();
  }
  if (!close_enough()) search_cliques();
  if (options_.method != Method::kExact && !close_enough()) branch_and_cut();
  if (!close_enough()) branch();
}

Status ComponentSolver::reason_to_stop() const {
  if (state_.complete) return Status::kOptimal;
  if (close_enough()) return Status::kGapReached;
  if (deadline_.interrupted()) return Status::kInterrupted;
  if (deadline_.expired() || out_of_time_) return Status::kTimeLimit;
  return options_.method == Method::kRelaxation ? Status::kIterationLimit : Status::kNodeLimit;
}

// Where branch and cut did not write down its steps, the multipliers prove the bound, or a search
// that the checker can do again.  Steps that end at an allowed gap may prove less than multipliers
// that were found on the way.
void ComponentSolver::finish_proof() {
  const bool is_open = state_.certificate < cutoff();
  if (proof_->size() > 0 && is_open && state_.certificate < state_.lower) return;
  proof_->cut_back(0);
  proof_->enter(component_);
  if (is_open && enumerated_) return proof_->search(state_.u, cutoff());
  if (is_open && searched_cliques_) return proof_->cliques({}, cutoff());
  proof_->bound(state_.u);
}

// Two dimensions: the relaxed problem is the problem.
void ComponentSolver::solve_assignment() {
  state_.method = "assignment";
  relax::LagrangianOptions loop = loop_options(component_);
  loop.max_evaluations = 1;
  relax::LagrangianResult result =
      relax::maximize_dual(component_, {}, loop, [&](const relax::RelaxedDual& point) {
        return recovery::recover_recursively(component_, point, options_.relaxation, deadline_);
      });
  offer(result.best, "assignment");
  accept_dual(std::move(result), "assignment");
}

void ComponentSolver::relax() {
  state_.method = "relaxation";
  relax::LagrangianOptions loop = loop_options(component_);
  loop.max_evaluations = options_.relaxation.max_evaluations;
  loop.recovery_interval =
      component_.num_dimensions() == 3 ? 1 : options_.relaxation.recovery_interval;
  recovery::keep_sets(options_.relaxation, deadline_.earlier(loop.certify_s), loop);
  const core::Permuted ordered(component_,
                               relax::set_order(component_, options_.relaxation.set_order, loop));
  if (options_.method == Method::kAuto) {
    loop.always_recover = false;  // there is a greedy packing
    if (component_.num_arcs() <= kMostCuttingArcs) {
      const auto many = static_cast<int>(component_.num_indices() / kIndicesPerEvaluation);
      loop.max_evaluations = std::min(loop.max_evaluations, std::max(kEvaluationsBeforeLp, many));
      loop.recovery_interval = 0;
      // Where there is no gap, that needs no packing to begin with.
      loop.settle = [&](std::span<const double> u, double lower) {
        accept_multipliers(ordered.to_source(u), lower, "relaxation");
        search_nearly_free();
        return state_.complete;
      };
    } else {
      loop.first_recovery = loop.recovery_interval =
          std::max(loop.recovery_interval, kLargeInterval);
    }
  }
  const auto recovery = recovery::make_recovery(options_.relaxation.recovery,
                                                ordered.component(),
                                                options_.relaxation,
                                                deadline_.earlier(loop.certify_s));
  const auto recover = [&](const relax::RelaxedDual& point) {
    Packing packing = recovery->recover(point);
    offer(ordered.to_source(packing), recovery->name());
    return packing;
  };
  const auto maximize = [&](std::span<const double> warm) {
    loop.goal = cutoff();
    relax::LagrangianResult result = relax::maximize_dual(ordered.component(), warm, loop, recover);
    result.u = ordered.to_source(result.u);
    accept_dual(std::move(result), "relaxation");
  };
  const int kept_sets = std::exchange(loop.kept.num_kept, std::min(2, loop.kept.num_kept));
  const bool keeps_more = kept_sets > 2 && component_.num_dimensions() > 3;
  if (!keeps_more || options_.relaxation.two_first) maximize({});
  if (!keeps_more || state_.complete) return;
  loop.kept.num_kept = kept_sets;
  maximize(options_.relaxation.two_first ? ordered.from_source(state_.u) : std::vector<double>());
}

void ComponentSolver::accept_dual(relax::LagrangianResult result, const char* event) {
  state_.evaluations += result.evaluations + result.kept_evaluations;
  state_.recoveries += result.recoveries;
  state_.nodes += result.kept_nodes;
  out_of_time_ = result.out_of_time;
  accept_multipliers(std::move(result.u), result.lower, event);
  raise_bound(result.kept_bound, event);
}

void ComponentSolver::accept_multipliers(std::vector<double> u,
                                         double certificate,
                                         const char* event) {
  if (certificate <= state_.certificate) return;
  state_.u = std::move(u);
  state_.certificate = certificate;
  raise_bound(certificate, event);
}

bool ComponentSolver::offer(const Packing& packing, const char* event) {
  if (packing.cost >= state_.best.cost) return false;
  accept(packing, event);
  reassign(0);
  return true;
}

void ComponentSolver::accept(const Packing& packing, const char* event) {
  if (!state_.feasible && covers_required(packing)) {
    state_.feasible = true;
    monitor_.component_feasible();
  }
  monitor_.moved(packing.cost - state_.best.cost, 0.0, event);
  state_.best = packing;
  raise_bound(state_.lower, event);
}

void ComponentSolver::raise_bound(double lower, const char* event) {
  // Nothing is cheaper than the best by less than the margin, so a bound in between proves the
  // best.
  const bool meets = std::max(lower, state_.lower) >= cutoff();
  if (meets) lower = std::max(lower, state_.best.cost - precision_.error);
  // A bound above all that covers what must be covered proves that nothing does.
  const bool hopeless =
      !state_.feasible && std::max(lower, state_.lower) > dearest_ + precision_.error;
  const bool done = (meets || hopeless) && !state_.complete;
  if (done) {
    state_.complete = true;
    monitor_.component_done();
  }
  const double rise = std::max(0.0, lower - state_.lower);
  if (rise > 0) state_.lower = lower;
  if (rise > 0 || done) monitor_.moved(0.0, rise, event);
}

bool ComponentSolver::covers_required(const Packing& packing) const {
  std::vector<bool> missing = required_;
  for (const ArcId a : packing.arcs) {
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { missing[slot] = false; });
  }
  return std::find(missing.begin(), missing.end(), true) == missing.end();
}

// No better packing is needed than one of this cost.
double ComponentSolver::search_goal() const {
  return state_.lower + allowed_gap_ + precision_.error;
}

bool ComponentSolver::close_enough() const {
  return state_.complete || (allowed_gap_ > 0 && state_.best.cost <= search_goal());
}

}  // namespace nda::pipeline
