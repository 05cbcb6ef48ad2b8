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

// Coordinate ascent is cheap and gives multipliers within some percent of the best; the linear
// program starts from the columns that they find cheap.  In two dimensions one flow is the answer.

namespace nda::bounded {
namespace {

using core::ArcId;

constexpr int kSweeps = 10;
// Above this the relaxation to two dimensions goes before the linear program.
constexpr std::size_t kManyArcs = 200000;
// Above this a good choice is recovered before it: the linear program takes a while to find one.
constexpr std::size_t kSlowLp = 10000;
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
  state_.live_arcs = component.num_arcs();
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
  const bool two_dimensional = component_.graph.num_dimensions() <= 2;
  if (two_dimensional) {
    assign();
  } else {
    if (!hint.u.empty()) accept(hint.u, "warm start");
    if (!hint.arcs.empty()) offer(greedy_descent(component_, hint.arcs, deadline_), "warm start");
    const std::vector<double> begin = hint.u.empty() ? state_.u : hint.u;
    if (!is_closed()) ascend(begin);
    ++state_.recoveries;
    offer(descend(state_.u, {}), "recovery");
    if (component_.num_arcs() > kSlowLp && !is_closed()) recover_at(state_.u);
    const bool relaxes = options_.method == Method::kRelaxation ||
                         (options_.method == Method::kAuto && component_.num_arcs() > kManyArcs);
    if (relaxes && !is_closed()) relax();
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

// All dimensions relaxed, from what the arcs of each index offer.
void BoundedSolver::ascend(std::span<const double> start) {
  SeparableDual function(component_);
  dual::MaximizeOptions limits;
  limits.max_evaluations = kSweeps;
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
void BoundedSolver::relax() {
  const RelaxationOptions& asked = options_.relaxation;
  const bool is_last = options_.method == Method::kRelaxation;
  LagrangianOptions loop = loop_options(asked, deadline_);
  loop.max_evaluations =
      is_last ? asked.max_evaluations : std::min(asked.max_evaluations, kEvaluationsBeforeLp);
  loop.recovery_interval = asked.recovery_interval;
  loop.margin = margin_;
  if (asked.kept_sets > 2 && asked.two_first) {
    LagrangianOptions two = loop;
    two.num_kept = 2;
    maximize(two);
    if (is_closed() || deadline_.reached()) return;
  }
  maximize(loop);
}

void BoundedSolver::maximize(const LagrangianOptions& loop) {
  const std::int64_t evaluations = state_.evaluations;
  const std::int64_t nodes = state_.nodes;
  const auto recover_from = [&](const RelaxedDual& point) { return recover(point); };
  const std::vector<double> start = state_.u;
  maximize_dual(component_, start, loop, recover_from, [&](const LagrangianResult& now) {
    state_.evaluations = evaluations + now.evaluations;
    state_.nodes = nodes + now.nodes;
    if (now.lower > state_.certificate) accept(now.u, "bound");
    raise(now.kept_bound, "bound");
    offer(now.best, "recovery");
    return !is_closed();
  });
}

// At any multipliers, two dimensions kept.
void BoundedSolver::recover_at(std::span<const double> u) {
  DualFunction point(component_);
  std::vector<double> subgradient(point.num_variables());
  point.evaluate(u.subspan(point.first_slot()), subgradient);
  ++state_.evaluations;
  offer(recover(point), "recovery");
}

// Greedily, by the report's recursion, or both, with exchanges.
Choice BoundedSolver::recover(const RelaxedDual& point) {
  ++state_.recoveries;
  std::vector<double> u(component_.rows.size());
  point.multipliers(u);
  clamp(component_, u);
  const RecoveryMethod method = options_.relaxation.recovery;
  if (method == RecoveryMethod::kDualGreedy) return descend(u, point.chosen_arcs());
  Choice best = recover_recursively(component_, point, options_.relaxation, deadline_);
  if (!options_.search.local_search && method != RecoveryMethod::kLocalSearch) return best;
  for (const std::span<const ArcId> start :
       {std::span<const ArcId>(best.arcs), point.chosen_arcs()}) {
    Choice improved = descend(u, start);
    if (improved.cost < best.cost) best = std::move(improved);
  }
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
