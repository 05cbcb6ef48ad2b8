#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bounded/kept_dual.hpp"
#include "core/clock.hpp"
#include "nda/options.hpp"

namespace nda::bounded {

/// Makes a choice from the last evaluation of a dual function, which keeps two dimensions or more.
using Recover = std::function<Choice(const RelaxedDual& point)>;

struct LagrangianOptions {
  DualMethod dual_method = DualMethod::kBundleTrust;  ///< kCoordinate counts as kBundleTrust
  int num_kept = 2;   ///< m; of N dimensions never more than N - 1, of two both
  bool merit = true;  ///< see KeptDual
  KeptSolver solve;   ///< for m >= 3
  int max_evaluations = 100;
  double relative_tolerance = 1e-7;
  /// Recover at evaluations 1, 1 + interval, ... (interval 0: at none), and at the best point.
  int recovery_interval = 1;
  bool certify = true;  ///< see LagrangianResult::lower
  double margin = 0;    ///< stop once the bound is as near to the best choice
  core::Deadline deadline;
};

struct LagrangianResult {
  std::vector<double> u;      ///< by slot, clamped: the best
  double lower = -kInfinity;  ///< what they prove; -inf if not asked to certify
  /// Three or more kept dimensions: the best RelaxedDual::bound(), perhaps above what any
  /// multipliers prove; else -inf.
  double kept_bound = -kInfinity;
  Choice best;  ///< the best recovered; nothing chosen if none is better
  std::int64_t evaluations = 0;
  std::int64_t recoveries = 0;
  std::int64_t nodes = 0;  ///< of searches for relaxed problems
};

/// The Lagrangian loop with bounds: maximises the dual function from the multipliers `warm` (by
/// slot), recovering choices on the way.  Source: report, section 3.3, steps A to D.
/// @param observe  told what is known after every evaluation; false stops.  May be empty.
/// Cost: evaluations * (O(A N) + one flow or search).
LagrangianResult maximize_dual(const BoundedComponent& component,
                               std::span<const double> warm,
                               const LagrangianOptions& options,
                               const Recover& recover,
                               const std::function<bool(const LagrangianResult&)>& observe = {});

}  // namespace nda::bounded
