#include "bounded/bounded_solver.hpp"

#include <algorithm>
#include <utility>

#include "bounded/bound.hpp"
#include "bounded/branch_and_bound.hpp"
#include "bounded/descent.hpp"
#include "bounded/dual_function.hpp"
#include "bounded/kept_solver.hpp"
#include "bounded/recursive.hpp"
#include "bounded/separable_dual.hpp"
#include "dual/maximize.hpp"

// The linear program starts from the columns that good multipliers find cheap.  Coordinate ascent
// gives some at once; in large parts it creeps, where an evaluation of two kept dimensions takes as
// long as a third of a sweep and 30 of them, by bundle trust, come within some percent of the best.
// From there recursive recovery finds at once what exchanges take long for.  In two dimensions one
// flow is the answer.

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr int kSweeps = 10;
constexpr int kFewSweeps = 2;
// Above this the relaxation to two dimensions goes before the linear program.
constexpr std::size_t kManyArcs = 5000;
constexpr int kEvaluationsBeforeLp = 30;
// A choice is recovered from the arcs of least reduced cost, so many per index.
constexpr std::size_t kRecoveredArcsPerIndex = 12;

}  // namespace

BoundedSolver::BoundedSolver(const BoundedComponent& component,
                             const Options& options,
                             double margin,
                             const core::Deadline& deadline,
                             Moved moved)
    : component_(component),
      options_(options),
      margin_(margin),
      deadline_(deadline),
      moved_(std::move(moved)) {
  state_.best = make_choice(component, {});
  state_.u.assign(component.rows.size(), 0.0);
  clamp(component, state_.u);
  state_.certificate = state_.lower = lagrangian_bound(component, state_.u);
  state_.live_arcs = state_.left_arcs = component.num_arcs();
}

void BoundedSolver::offer(const Choice& choice, const char* event) {
  if (choice.cost >= state_.best.cost) return;
  const double change = choice.cost - state_.best.cost;
  state_.best = choice;
  if (moved_) moved_(change, 0, event);
}

void BoundedSolver::start(const BoundedHint& hint) {
  if (deadline_.reached()) {
    state_.stopped = out_of_time();
    return;
  }
  if (component_.graph.num_dimensions() <= 2) {
    assign();
  } else {
    if (!hint.u.empty()) accept(hint.u, "warm start");
    if (!hint.arcs.empty()) offer(greedy_descent(component_, hint.arcs, deadline_), "warm start");
    if (!is_closed()) approximate(hint.u.empty() ? state_.u : hint.u);
  }
  close();
  if (state_.complete) return;
  state_.stopped = deadline_.reached() ? out_of_time() : Status::kIterationLimit;
}

void BoundedSolver::finish(double allowed_gap) {
  if (state_.complete) return;
  if (state_.best.cost - state_.lower <= allowed_gap) {
    state_.stopped = Status::kGapReached;
  } else if (deadline_.reached()) {
    state_.stopped = out_of_time();
  } else if (options_.method != Method::kRelaxation) {
    branch(allowed_gap);
  }
}

// Multipliers near the best, and a choice.
void BoundedSolver::approximate(const std::vector<double>& start) {
  const bool is_last = options_.method == Method::kRelaxation;
  const bool relaxes =
      is_last || (options_.method == Method::kAuto && component_.num_arcs() > kManyArcs);
  ascend(start, relaxes ? kFewSweeps : kSweeps);
  if (relaxes) {
    if (!is_closed()) relax(is_last);
  } else {
    ++state_.recoveries;
    offer(descend(state_.u, {}), "recovery");
  }
}

// All dimensions relaxed, from what the arcs of each index offer.
void BoundedSolver::ascend(std::span<const double> start, int sweeps) {
  SeparableDual function(component_);
  dual::MaximizeOptions limits;
  limits.max_evaluations = sweeps;
  dual::MaximizeResult found = dual::maximize_coordinate(
      function, start, limits, [&](const dual::Iterate&) { return !deadline_.reached(); });
  state_.evaluations += found.evaluations;
  accept(std::move(found.point), "bound");
}

// Two dimensions are a flow, whose integral optimum is that of the relaxation.
void BoundedSolver::assign() {
  state_.method = "assignment";
  DualFunction function(component_);
  std::vector<double> nothing(function.num_variables());
  function.evaluate(nothing, nothing);
  ++state_.evaluations;
  const std::span<const ArcId> arcs = function.chosen_arcs();
  offer(make_choice(component_, {arcs.begin(), arcs.end()}), "assignment");
  std::vector<double> u(component_.rows.size(), 0.0);
  function.multipliers(u);
  accept(std::move(u), "bound");
}

// The report's loop, sections 3 and 4: two sets kept, or as many as asked for, the others relaxed.
// Before a linear program few evaluations do, in half of the time, and a single recovery.
void BoundedSolver::relax(bool is_last) {
  const RelaxationOptions& asked = options_.relaxation;
  LagrangianOptions loop = loop_options(asked, deadline_);
  loop.max_evaluations =
      is_last ? asked.max_evaluations : std::min(asked.max_evaluations, kEvaluationsBeforeLp);
  const int interval = component_.graph.num_dimensions() == 3 ? 1 : asked.recovery_interval;
  loop.recovery_interval = is_last ? interval : 0;
  loop.margin = margin_;
  const double left_s = deadline_.remaining_s();
  if (!is_last && left_s < kInfinity) loop.deadline = deadline_.earlier(left_s / 2);
  if (asked.kept_sets > 2 && asked.two_first) {
    LagrangianOptions two = loop;
    two.num_kept = 2;
    maximize(two);
    if (is_closed() || deadline_.reached()) return;
  }
  maximize(loop);
  // Where cells are used several times, multipliers of the flow prove less than its value.
  if (!is_closed() && !deadline_.reached()) ascend(state_.u, is_last ? kSweeps : kFewSweeps);
}

void BoundedSolver::maximize(const LagrangianOptions& loop) {
  const std::int64_t evaluations = state_.evaluations;
  const std::int64_t nodes = state_.nodes;
  const auto learn = [&](const LagrangianResult& now) {
    state_.evaluations = evaluations + now.evaluations;
    state_.nodes = nodes + now.nodes;
    if (now.lower > state_.certificate) accept(now.u, "bound");
    raise(now.kept_bound, "bound");
    offer(now.best, "recovery");
    return !is_closed();
  };
  const auto recover_from = [&](const RelaxedDual& point) { return recover(point); };
  const std::vector<double> start = state_.u;
  learn(maximize_dual(component_, start, loop, recover_from, learn));
}

// Greedily, by the report's recursion, or both, with exchanges; where exchanges take long, the
// recursion is the better start.
Choice BoundedSolver::recover(const RelaxedDual& point) {
  ++state_.recoveries;
  std::vector<double> u(component_.rows.size());
  point.multipliers(u);
  clamp(component_, u);
  const RecoveryMethod method = options_.relaxation.recovery;
  if (method == RecoveryMethod::kDualGreedy) return descend(u, point.chosen_arcs());
  Choice best = recover_recursively(component_, point, options_.relaxation, deadline_);
  if (!options_.search.local_search && method != RecoveryMethod::kLocalSearch) return best;
  const auto improve = [&](Choice improved) {
    if (improved.cost < best.cost) best = std::move(improved);
  };
  improve(descend(u, best.arcs));
  if (component_.num_arcs() <= kManyArcs) improve(descend(u, point.chosen_arcs()));
  return best;
}

// What is preferred comes first, then the arcs of low reduced cost.
Choice BoundedSolver::descend(std::span<const double> u, std::span<const ArcId> preferred) const {
  std::vector<std::pair<double, ArcId>> order;
  for (ArcId a = 0; a < component_.num_arcs(); ++a)
    order.emplace_back(core::reduced_cost(component_.graph, u, a), a);
  const std::size_t count = std::min(order.size(), kRecoveredArcsPerIndex * component_.rows.size());
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(count);
  std::partial_sort(order.begin(), end, order.end());
  std::vector<ArcId> arcs(preferred.begin(), preferred.end());
  std::for_each(order.begin(), end, [&](const auto& one) {
    if (!std::binary_search(preferred.begin(), preferred.end(), one.second))
      arcs.push_back(one.second);
  });
  return greedy_descent(component_, arcs, deadline_);
}

void BoundedSolver::branch(double allowed_gap) {
  state_.method = "branch and bound";
  const SearchLimits limits{margin_, allowed_gap, options_.branch.max_nodes, deadline_};
  const SearchNews news{[&](const Choice& choice) { offer(choice, "search"); },
                        [&](double lower) { raise(lower, "bound"); }};
  const SearchResult found = branch_and_bound(component_, state_.best, state_.u, limits, news);
  state_.nodes += found.nodes;
  state_.live_arcs = found.live_arcs;
  state_.left_arcs = found.left_arcs;
  accept(found.u, "bound");
  raise(found.lower, "bound");
  switch (found.end) {
    case SearchEnd::kComplete:
      state_.complete = true;
      state_.stopped = Status::kOptimal;
      break;
    case SearchEnd::kGap:
      state_.stopped = Status::kGapReached;
      break;
    case SearchEnd::kNodes:
      state_.stopped = Status::kNodeLimit;
      break;
    case SearchEnd::kDeadline:
      state_.stopped = out_of_time();
      break;
  }
}

void BoundedSolver::accept(std::vector<double> u, const char* event) {
  clamp(component_, u);
  const double certificate = lagrangian_bound(component_, u);
  if (certificate <= state_.certificate) return;
  state_.u = std::move(u);
  state_.certificate = certificate;
  raise(certificate, event);
}

void BoundedSolver::raise(double lower, const char* event) {
  if (lower <= state_.lower) return;
  const double change = lower - state_.lower;
  state_.lower = lower;
  if (moved_) moved_(0, change, event);
}

void BoundedSolver::close() {
  state_.complete = is_closed();
  if (state_.complete) state_.stopped = Status::kOptimal;
}

Status BoundedSolver::out_of_time() const {
  return deadline_.interrupted() ? Status::kInterrupted : Status::kTimeLimit;
}

}  // namespace nda::bounded
