#include <algorithm>
#include <utility>

#include "core/random.hpp"
#include "cutting/widening.hpp"
#include "recovery/core_search.hpp"
#include "recovery/greedy.hpp"
#include "relax/relaxed_dual.hpp"
#include "rows/cut_rounds.hpp"
#include "solve/component_solver.hpp"

// How a component is cut: by linear programs, cuts and branching on the arcs that reduced costs
// leave.  Where a linear program takes long, or would be too large, cuts over three indices come
// first, as rows of the Lagrangian dual: they close nearly as much of the gap as the same cuts in a
// linear program, most of it before that has its first bound.

namespace nda::pipeline {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

// A rounded point is worth descending from when it misses the best by at most this share of the
// gap.
constexpr double kPromising = 0.25;

}  // namespace

// On the arcs that reduced costs leave, as a component of their own.
void ComponentSolver::branch_and_cut() {
  const std::vector<ArcId> live = live_arcs();
  state_.live_arcs = live.size();
  note_left(live.size());
  if (live.empty()) return;
  core::Cutter cutter;
  const Component core = cutter.cut(component_, live, deadline_);
  const bool on_averages = wants_averaged_cuts(core);
  if (deadline_.reached() || (!on_averages && live.size() > kMostCuttingArcs)) return;
  state_.method = "branch and cut";
  if (proof_ != nullptr) {
    proof_->fix(state_.u, cutoff());
    proof_->enter(core);
  }
  cutting::WideningLimits limits;
  limits.margin = std::max(precision_.margin, allowed_gap_);
  limits.context.step = precision_.step();
  limits.context.is_dense = recovery::DimensionwiseSearch::suits(component_);
  if (!on_averages) {
    search_circles(core, live, limits);
    return;
  }
  limits.lower_without_cuts = state_.certificate;
  const rows::CutRoundsResult cuts = cut_on_averages(core, limits.margin);
  const std::size_t proof_size = proof_ == nullptr ? 0 : proof_->size();
  state_.live_arcs = cuts.live.size();
  note_left(cuts.live.size());
  if (!close_enough() && !deadline_.reached() && cuts.live.size() <= kMostCuttingArcs) {
    const Component left = cutter.cut(core, cuts.live);
    const std::vector<std::uint32_t> slots = core::slots_in_part(core, left);
    for (const cutting::CutRow& row : cuts.rows) {
      cutting::Cut cut = cutting::restrict_cut(row.cut, slots);
      if (cut.slots.size() > 1) limits.cuts.push_back(std::move(cut));
    }
    if (proof_ != nullptr) proof_->enter(left);
    if (search_circles(left, core::at_positions(live, cuts.live), limits) > cuts.lower) return;
  }
  if (proof_ == nullptr) return;
  proof_->cut_back(proof_size);
  proof_->enter(core);
  proof_->bound(cuts.u, cutting::proof_cuts(cuts.rows));
}

bool ComponentSolver::wants_averaged_cuts(const Component& core) const {
  return core.num_dimensions() > 2 && (core.num_arcs() > kMostCuttingArcs ||
                                       core.num_indices() >= options_.branch.averaged_cuts_indices);
}

// Cuts without a linear program; the bound is raised on the way.
rows::CutRoundsResult ComponentSolver::cut_on_averages(const Component& core, double margin) {
  rows::CutRoundOptions options;
  options.assign2d = options_.relaxation.assign2d;
  const auto goal = [&] { return state_.best.cost - margin; };
  options.cutoff = goal();
  options.deadline = deadline_;
  options.proof = proof_;
  options.certify_s = certify_s_ * static_cast<double>(core.num_arcs()) /
                      static_cast<double>(component_.num_arcs());
  const std::vector<double> u = core::restrict_slots(component_, state_.u, core);
  std::vector<ArcId> arcs;  // the last average
  std::vector<double> values;
  const auto observe = [&](const rows::CutPoint& point) {
    raise_bound(std::min(point.lower, goal()), "cuts");
    arcs.clear();
    for (const ArcId a : point.arcs) arcs.push_back(core::original_arc(point.component, a));
    values.assign(point.values.begin(), point.values.end());
    return goal();
  };
  rows::CutRoundsResult result = rows::run_cut_rounds(core, u, options, observe);
  state_.evaluations += result.evaluations;
  raise_bound(std::min(result.lower, goal()), "cuts");
  if (close_enough() || deadline_.reached()) return result;
  Packing packing = round(core, core::arcs_from_original(core, std::move(arcs)), values, result.u);
  packing.arcs = core::arcs_from_part(component_, core, std::move(packing.arcs));
  offer(packing, "cuts");
  return result;
}

// By linear programs, cuts and branching, in widening circles; what they prove.
double ComponentSolver::search_circles(const Component& core,
                                       std::span<const ArcId> live,
                                       cutting::WideningLimits& limits) {
  const std::vector<double> u = core::restrict_slots(component_, state_.u, core);
  const auto goal = [&] { return state_.best.cost - limits.margin; };
  limits.cutoff = goal();
  limits.context.for_all = for_all_;
  limits.max_nodes = options_.branch.max_nodes - state_.nodes;
  limits.context.deadline = deadline_;
  limits.context.proof = proof_;
  cutting::WideningObserver observer;
  observer.offer = [&](const cutting::Master& point, const Packing* found) {
    const Component& relaxed = point.component();
    Packing packing =
        found != nullptr ? *found : round(relaxed, point.arcs(), point.values(), point.u());
    packing.arcs = core::arcs_from_part(component_, relaxed, std::move(packing.arcs));
    offer(packing, "branch and cut");
    return goal();
  };
  observer.relaxed = [&](const cutting::Master& point) { adopt_multipliers(core, point.u()); };
  observer.improve = [&](cutting::Master& point, const cutting::PrimalBudget& budget) {
    improve(core, live, point, budget);
    return goal();
  };
  observer.raise = [&](double lower) { raise_bound(std::min(lower, goal()), "cuts"); };
  const cutting::WideningResult result = cutting::search_widening(core, u, limits, observer);
  state_.nodes += result.nodes;
  note_left(result.live_arcs);
  state_.searches += result.fixing;
  return result.lower;
}

// Those of a linear program prove more than those of the relaxation.
void ComponentSolver::adopt_multipliers(const Component& core, std::span<const double> core_u) {
  std::vector<double> u = state_.u;
  core::extend_slots(core, core_u, component_, u);
  const double certificate = relax::make_feasible(component_, u, deadline_);
  accept_multipliers(std::move(u), certificate, "linear program");
}

// A packing near a relaxed point: its largest values first, then descent.
Packing ComponentSolver::round(const Component& core,
                               std::span<const ArcId> arcs,
                               std::span<const double> values,
                               std::span<const double> u) const {
  const Packing packing = recovery::round_values(core, arcs, values);
  const double gap = state_.best.cost - state_.lower;
  if (packing.cost > state_.best.cost + kPromising * gap) return packing;
  recovery::CoreSearchOptions search;
  search.kicks_per_index = 0;
  search.goal = search_goal();
  core::Random random(seed_);
  return recovery::search_core(
      core, u, cutoff() - state_.lower, packing, search, random, deadline_);
}

}  // namespace nda::pipeline
