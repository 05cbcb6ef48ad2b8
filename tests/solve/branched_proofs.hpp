#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "bnb/branch_and_bound.hpp"
#include "core/reduced_costs.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/problem.hpp"
#include "nda/proof.hpp"
#include "relax/ascent.hpp"
#include "relax/relaxed_dual.hpp"
#include "solve/component_solver.hpp"
#include "solve/singletons.hpp"
#include "solve/tree_reduction.hpp"

// Proofs by branching on indices.  End to end `--method exact` enumerates whatever is small; here
// it branches from the first arc on, bounded by a few steps of coordinate ascent.

namespace nda {

inline bnb::NodeBound ascend(const core::Component& node, std::span<const double> warm) {
  relax::Ascent ascent(node, core::all_arcs(node), {warm.begin(), warm.end()});
  ascent.climb(2, 0);
  bnb::NodeBound bound{ascent.u(), 0, {}};
  bound.lower = relax::make_feasible(node, bound.u, {});
  const double inherited = std::accumulate(warm.begin(), warm.end(), 0.0);
  if (inherited > bound.lower) bound = {{warm.begin(), warm.end()}, inherited, {}};
  return bound;
}

inline bnb::Collaborators ascending() {
  return {[](const core::Component& node, std::span<const double> warm, double) {
            return ascend(node, warm);
          },
          pipeline::reduce_node};
}

struct BranchedProof {
  Proof proof;
  double lower = 0;  ///< what branch and bound says
  std::int64_t nodes = 0;
  bool complete = true;
};

/// @param enumerated  arcs of a node that is enumerated, at most.
inline BranchedProof prove_by_branching(const Problem& problem,
                                        std::size_t enumerated,
                                        bool in_writing = true,
                                        std::int64_t max_nodes = 1000000) {
  const core::Shift shift = core::make_shift(problem);
  const core::CostGrid grid = core::find_grid(problem);
  const decompose::Partition partition = decompose::partition(problem, shift);
  BranchedProof result;
  result.proof.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  result.proof.num_arcs = problem.num_arcs();
  result.proof.grid = grid.step;
  result.lower = shift.constant;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    core::Cutter cutter;
    const core::Component component = cutter.cut(problem, shift, partition.component(c));
    const pipeline::Precision precision = pipeline::precision_of(component, grid);
    bnb::ProofLog log(component, pipeline::charges(component, shift), precision.error);
    std::vector<double> u(component.num_slots(), 0.0);
    relax::make_feasible(component, u, {});
    bnb::BranchLimits limits;
    limits.enumeration_arcs = enumerated;
    limits.max_nodes = max_nodes;
    limits.margin = precision.margin;
    limits.error = precision.error;
    limits.proof = in_writing ? &log : nullptr;
    const bnb::SearchResult found =
        bnb::branch_and_bound(component, u, -limits.margin, ascending(), limits);
    const double best = found.found ? found.best.cost : 0;
    result.lower += found.complete ? best - limits.error : std::min(found.lower, -limits.margin);
    result.nodes += found.nodes;
    result.complete = result.complete && found.complete;
    result.proof.parts.push_back(log.take());
  }
  return result;
}

}  // namespace nda
