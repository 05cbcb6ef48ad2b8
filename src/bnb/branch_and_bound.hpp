#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "bnb/enumerate.hpp"
#include "bnb/tree_log.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::bnb {

/// What a relaxation says of a component.
struct NodeBound {
  std::vector<double> u;  ///< by slot, u <= 0, all reduced costs >= 0: sum u is a lower bound
  double lower = 0;       ///< sum u
  core::Packing packing;  ///< a packing found on the way; empty is fine
};

/// A component after fixing: arcs taken for good, and the connected parts that are left.
struct Reduction {
  core::Packing taken;                 ///< original arcs
  std::vector<ForcedArc> forced;       ///< the same, and why
  std::vector<core::Component> parts;  ///< cut out of it: arc_origin counts as everywhere
  std::vector<std::vector<double>> u;  ///< of each part, by slot
};

/// What branch and bound asks of the layers above; injected, so that it knows no relaxation.
struct Collaborators {
  /// Bounds a component from below, starting at multipliers `warm` (by slot).  It may stop early
  /// once the bound reaches `cutoff`.
  std::function<NodeBound(const core::Component&, std::span<const double> warm, double cutoff)>
      bound;

  /// Fixes by reduced cost and splits, looking for packings cheaper than `cutoff`.  Where a proof
  /// is written down, all that it drops must follow from the multipliers of the bound.
  std::function<Reduction(const core::Component&, const NodeBound&, double cutoff)> reduce;
};

struct BranchLimits {
  std::int64_t max_nodes = std::numeric_limits<std::int64_t>::max();
  std::size_t enumeration_arcs = 200;      ///< parts of at most so many arcs are enumerated
  std::int64_t enumeration_nodes = 20000;  ///< a part that takes more is bounded again instead
  double margin =
      0;  ///< only packings cheaper than the best by more than this are looked for; >= error
  double error = 0;  ///< rounding: two costs that differ by less are equal (docs/numerics.md)
  double gap = 0;    ///< the best may miss the optimum by this; the bound then says so
  core::Deadline deadline;
  ProofLog* proof = nullptr;  ///< where to write down the tree; may be null
};

/// Depth-first branch and bound over a component, best child first.
///
/// A node is a component of its own: bound it, fix and drop arcs, split what is left into connected
/// parts that are solved one by one, each against what the others leave of the cutoff; a part that
/// stays whole is branched on one index: which arc covers it, or none.
///
/// The result's lower bound holds whenever the search stops.  Its arcs are original ones
/// (original_arc()).
///
/// Nodes more than kMostProofBranchings deep are left open.
///
/// On a grid of costs (core/shift.hpp) margin is nearly its step: nothing lies between the best
/// cost and the next cheaper grid point, so a complete search proves best.cost - error, not
/// best.cost - margin.  With a gap above the margin it proves best.cost - gap.
SearchResult branch_and_bound(const core::Component& component,
                              std::span<const double> u,
                              double cutoff,
                              const Collaborators& collaborators,
                              const BranchLimits& limits);

}  // namespace nda::bnb
