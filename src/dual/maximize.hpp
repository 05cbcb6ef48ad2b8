#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "dual/concave_function.hpp"

namespace nda::dual {

/// What an observer sees after every evaluation.
struct Iterate {
  int evaluation = 0;                 ///< 1 = the start point
  double value = 0;                   ///< q at the point just evaluated
  double best_value = 0;              ///< best so far
  std::span<const double> point;      ///< the point just evaluated
  bool serious = false;               ///< the centre moved here
};

/// Returns false to stop the maximiser.
using Observer = std::function<bool(const Iterate&)>;

/// Common limits.  All methods count work in evaluations, never in seconds.
struct MaximizeOptions {
  int max_evaluations = 200;             ///< >= 1
  double relative_tolerance = 1e-7;      ///< stop when the predicted increase <= this * max(1, |q|)
  double target = std::numeric_limits<double>::infinity();  ///< stop when q reaches it (upper bound known)
  int bundle_size = 40;                  ///< bundle methods: subgradients kept; >= 2
  bool primal_weights = false;           ///< report the convex combination behind the aggregate
};

/// Why a maximiser stopped.
enum class StopReason { kConverged, kTargetReached, kEvaluationLimit, kObserver };

/// Answer of a maximiser.
struct MaximizeResult {
  std::vector<double> point;   ///< best point found
  double value = -std::numeric_limits<double>::infinity();  ///< q there
  int evaluations = 0;
  int serious_steps = 0;
  StopReason reason = StopReason::kEvaluationLimit;
};

}  // namespace nda::dual
