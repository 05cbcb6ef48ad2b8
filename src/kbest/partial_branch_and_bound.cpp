#include "kbest/partial_branch_and_bound.hpp"

#include <algorithm>
#include <utility>

#include "kbest/packing_buffer.hpp"
#include "kbest/packing_sums.hpp"
#include "nda/assign2d_k_best.hpp"
#include "recovery/inner_problem.hpp"
#include "relax/dual_function.hpp"
#include "relax/lagrangian.hpp"

// Partial enumeration within the paradigm of branch and bound: the alignments that nonsmooth
// optimisation passes are the branches worth a look, all others (the paper's Y-bar) are left out.
// That is why nothing here is proven.
//
// What differs from the paper: a recovery problem falls apart as a rule (report, 4.7), and its
// parts are searched one by one.  Each keeps a solution buffer of its own; the best sums of one
// packing of each part, of which there are far more than of followed branches, go into the buffer
// of the stage.  What the other parts cost at least lowers the cutoff of a part.

namespace nda::kbest {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using recovery::InnerResult;
using recovery::RecoveryProblem;
using relax::Alignment;

// The multipliers of an alignment, by slot of the component.
std::vector<double> multipliers(const Component& component, const Alignment& alignment) {
  std::vector<double> u(component.num_slots(), 0.0);
  std::copy_backward(alignment.point.begin(), alignment.point.end(), u.end());
  return u;
}

}  // namespace

std::vector<Packing> PartialBranchAndBound::rank(const Component& component,
                                                 std::span<const double> warm) {
  return rank(component, warm, options_.relaxation.max_evaluations, kInfinity);
}

std::vector<Packing> PartialBranchAndBound::rank(const Component& component,
                                                 std::span<const double> warm,
                                                 int max_evaluations,
                                                 double cutoff) {
  if (component.num_dimensions() == 2) return assign(component, cutoff);
  const bool by_murty = options_.ranking.method == RankingMethod::kMurty;
  relax::LagrangianOptions loop = relax::loop_options(options_.relaxation, deadline_);
  loop.num_alignments = by_murty ? 1 : static_cast<std::size_t>(options_.ranking.branches);
  loop.max_evaluations = max_evaluations;
  loop.relative_tolerance = options_.relaxation.relative_tolerance;
  loop.goal = cutoff;
  relax::LagrangianResult relaxed = relax::maximize_dual(component, warm, loop, {});
  work_.evaluations += relaxed.evaluations;
  if (relaxed.lower >= cutoff) return {};
  if (by_murty && !relaxed.alignments.empty())
    relaxed.alignments = best_assignments(component, relaxed.alignments.front());
  const Stage stage{component, relax::find_cells(component)};
  PackingBuffer buffer(k_);
  for (const Alignment& alignment : relaxed.alignments) {
    if (deadline_.reached()) break;
    buffer.add_best(follow(stage, alignment, std::min(cutoff, buffer.cutoff())), deadline_);
  }
  return buffer.take(deadline_);
}

// In two dimensions relaxed solutions are solutions, and the k best are known exactly.
std::vector<Packing> PartialBranchAndBound::assign(const Component& component, double cutoff) {
  ++work_.leaves;
  relax::DualFunction function(component, options_.relaxation.assign2d, deadline_);
  function.evaluate({}, {});
  Assign2dRanking ranking(function.assignment());
  std::vector<Packing> packings;
  Assign2dResult answer;
  for (std::size_t rank = 0; rank < k_ && !deadline_.reached() && ranking.next(answer); ++rank) {
    std::vector<ArcId> arcs;
    for (const std::uint32_t cell : function.cells_of(answer))
      arcs.push_back(function.cells().first_arc[cell]);
    Packing packing = core::make_packing(component, std::move(arcs));
    if (packing.cost >= cutoff) break;
    packings.push_back(std::move(packing));
  }
  std::ranges::stable_sort(packings, {}, &Packing::cost);  // that of assignments rounds otherwise
  return packings;
}

// Murty's branching rule: the best assignments of the multipliers where `best` was found.
std::vector<Alignment> PartialBranchAndBound::best_assignments(const Component& component,
                                                               const Alignment& best) const {
  relax::DualFunction function(component, options_.relaxation.assign2d, deadline_);
  std::vector<double> subgradient(best.point.size());
  function.evaluate(best.point, subgradient);
  Assign2dRanking ranking(function.assignment());
  std::vector<Alignment> alignments;
  Assign2dResult answer;
  while (static_cast<int>(alignments.size()) < options_.ranking.branches && !deadline_.reached() &&
         ranking.next(answer)) {
    alignments.push_back({function.cells_of(answer), best.point, best.value, best.violation});
  }
  return alignments;
}

// The best packings that conform to an alignment and cost less than the cutoff.
std::vector<Packing> PartialBranchAndBound::follow(const Stage& stage,
                                                   const Alignment& alignment,
                                                   double cutoff) {
  ++work_.branches;
  const RecoveryProblem problem =
      recovery::make_recovery_problem(stage.component, stage.cells, alignment.cells, deadline_);
  const std::vector<Component> parts =
      recovery::cut_parts(problem, deadline_, options_.relaxation.decompose);
  const std::vector<double> u = multipliers(stage.component, alignment);
  std::vector<InnerResult> inner;
  double lower = recovery::recovered_packing(stage.component, problem, {}).cost;
  for (const Component& part : parts) {
    inner.push_back(recovery::maximize_inner(
        {stage.component, problem, part}, u, options_.relaxation, deadline_));
    lower += inner.back().lower;
  }
  if (deadline_.reached()) return {};
  if (lower >= cutoff) {
    ++work_.cut;
    return {};
  }
  std::vector<std::vector<Packing>> lists;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    lists.push_back(rank(parts[p],
                         inner[p].u,
                         options_.relaxation.recovery_evaluations,
                         cutoff - (lower - inner[p].lower)));
    if (lists.back().empty()) return {};
    lower += lists.back().front().cost - inner[p].lower;
  }
  std::vector<Packing> packings;
  for (const PackingChoice& choice : cheapest_choices(lists, k_, deadline_)) {
    if (packings.size() >= kFewPackings && deadline_.reached()) break;
    std::vector<ArcId> arcs;
    for (const auto& [p, i] : choice) {
      for (const ArcId a : lists[p][i].arcs) arcs.push_back(parts[p].arc_origin[a]);
    }
    packings.push_back(recovery::recovered_packing(stage.component, problem, arcs));
  }
  return packings;
}

}  // namespace nda::kbest
