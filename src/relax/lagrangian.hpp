#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "relax/alignment.hpp"
#include "relax/kept_dual.hpp"

namespace nda::relax {

/// Makes a packing from the last evaluation of the dual function; injected by the layer above.
/// What it gets keeps two sets or more.
using Recover = std::function<core::Packing(const RelaxedDual& point)>;
/// Whether there is nothing left to recover, as feasible multipliers and their bound settle it.
using Settle = std::function<bool(std::span<const double> u, double lower)>;

struct LagrangianOptions {
  DualMethod dual_method = DualMethod::kBundleTrust;
  KeptSets kept;  ///< two; of a component of two dimensions always both
  Assign2dMethod assign2d = Assign2dMethod::kShortestPath;
  int max_evaluations = 100;
  int bundle_size = 40;  ///< subgradients that the bundle keeps
  double relative_tolerance = 1e-7;
  /// Which evaluation is the best point for recovery, and how many distinct alignments are kept.
  AlignmentRule alignment_rule = AlignmentRule::kBestValue;
  std::size_t num_alignments = 1;
  /// Recover at evaluations first, first + interval, ... (interval 0: at none), and at the best
  /// point.
  int recovery_interval = 1;
  int first_recovery = 1;
  bool always_recover = true;  ///< once, however little time is left
  double goal = kInfinity;     ///< stop once the bound reaches it: nothing cheaper is wanted
  bool certify = true;  ///< make the multipliers feasible at the end: without it lower is -inf
  Settle settle;        ///< asked before the recovery at the best point; may be empty
  core::Deadline deadline;
  double certify_s = 0;  ///< what is kept of the time until the deadline for that end
};

/// The loop as these options want it at every stage; all else is the default, two kept sets among
/// it.
LagrangianOptions loop_options(const RelaxationOptions& options, const core::Deadline& deadline);

struct LagrangianResult {
  std::vector<double> u;      ///< multipliers of all slots: u <= 0, all reduced costs >= 0
  double lower = -kInfinity;  ///< sum u, a lower bound on every packing; -inf if there was no time
  /// Three or more kept sets: the best RelaxedDual::bound(), a lower bound too, perhaps above what
  /// any multipliers prove; else -inf.
  double kept_bound = -kInfinity;
  core::Packing best;                 ///< best recovered packing; empty (cost 0) if none is better
  std::vector<Alignment> alignments;  ///< best first; one of the coordinate method
  int evaluations = 0;
  int recoveries = 0;
  bool out_of_time = false;           ///< the deadline, or what is kept of it, cut this short
  std::int64_t kept_evaluations = 0;  ///< of dual functions of relaxed problems
  std::int64_t kept_nodes = 0;        ///< of exact searches for their best packings
};

/// The Lagrangian loop: maximises the dual function of a component from the multipliers `warm` (by
/// slot; empty = 0), recovering packings on the way.  Source: report, section 3.3, steps A to D.
/// With m < 2 kept sets packings are recovered from the alignment of two at the same multipliers;
/// DualMethod::kCoordinate is for m = 0, whatever is asked for.  No evaluation is begun that would
/// end beyond the deadline, by the time of the last; but one is, whatever it takes, unless no time
/// is left at all.  Cost: evaluations * (O(A N) + one 2-D assignment).
LagrangianResult maximize_dual(const core::Component& component,
                               std::span<const double> warm,
                               const LagrangianOptions& options,
                               const Recover& recover);

}  // namespace nda::relax
