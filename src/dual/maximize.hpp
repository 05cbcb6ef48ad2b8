#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "dual/concave_function.hpp"
#include "nda/options.hpp"

namespace nda::dual {

/// What an observer sees after every evaluation.
struct Iterate {
  int evaluation = 0;             ///< 1 = the start point
  double value = 0;               ///< q at the point just evaluated
  double best_value = 0;          ///< best so far, this one included
  std::span<const double> point;  ///< the point just evaluated
  bool serious = false;           ///< the centre moved here
  /// alpha in [0, 1], volume algorithm only: who averages primal points sets
  /// average = (1 - alpha) average + alpha x, where x is the primal point of this evaluation.
  double primal_step = 0;
};

/// Returns false to stop the maximiser.
using Observer = std::function<bool(const Iterate&)>;

/// How the volume algorithm steps.  The defaults suit few evaluations from far off; {0.1, 5} suits
/// a start near the maximum, where most single subgradients lead nowhere and only a long average
/// does.
struct VolumeSteps {
  double first_alpha = 0.8;  ///< most that a subgradient counts in the average at first; in (0, 1]
  int patience = 1;          ///< steps without increase that shorten the next ones; >= 1
};

/// Common limits.  All methods count work in evaluations, never in seconds.
///
/// Tolerances are relative to S = max(|q(best)|, q(best) - q(start)), so that scaling q or u
/// changes nothing.
struct MaximizeOptions {
  int max_evaluations = 200;         ///< >= 1
  double relative_tolerance = 1e-7;  ///< stop when the possible increase <= this * S; >= 0
  double target = std::numeric_limits<double>::infinity();  ///< stop when q reaches it
  /// Bundle trust: subgradients kept; >= 2.  A polyhedral q takes many times the evaluations if
  /// they are fewer than the variables.
  int bundle_size = 100;
  bool primal_weights = false;  ///< fill MaximizeResult::primal_weights
  /// Guess of max q - q(start) that sets the first step; 0 = from q itself.
  double expected_increase = 0;
  /// Bundle trust: first step parameter t (see MaximizeResult::step); 0 = from expected_increase.
  double initial_step = 0;
  VolumeSteps volume;
};

/// Why a maximiser stopped.
enum class StopReason { kConverged, kTargetReached, kEvaluationLimit, kObserver };

/// Answer of a maximiser.
///
/// For every w:  q(w) <= value + aggregate_error + aggregate_norm * |w - centre|,  where centre is
/// the last serious point (bundle trust, volume).
struct MaximizeResult {
  std::vector<double> point;                                ///< best point found
  double value = -std::numeric_limits<double>::infinity();  ///< q there
  int evaluations = 0;
  int serious_steps = 0;  ///< evaluations that moved the centre, the first one not counted
  StopReason reason = StopReason::kEvaluationLimit;
  double aggregate_norm = std::numeric_limits<double>::infinity();   ///< |g| of the aggregate
  double aggregate_error = std::numeric_limits<double>::infinity();  ///< its linearisation error
  double step = 0;  ///< bundle trust: last t, the start for a similar problem
  /// If asked for: the aggregate subgradient is the sum of weight[e - 1] times the subgradient of
  /// evaluation e, weights >= 0 with sum 1.  The same combination of primal points is a (nearly
  /// feasible, nearly optimal) point of the convexified primal.  Bundle trust and volume only.
  std::vector<double> primal_weights;
};

/// Throws InputError naming the first option out of range.
void validate(const MaximizeOptions& options);

/// Bundle trust method of Schramm & Zowe (SIAM J. Optim. 2, 1992): best value for few evaluations.
/// Memory: (bundle_size + 2) n numbers; cost of a step: bundle_size passes over n, plus the master.
MaximizeResult maximize_bundle_trust(ConcaveFunction& function,
                                     std::span<const double> start,
                                     const MaximizeOptions& options,
                                     const Observer& observer = {});

/// Subgradient method with Polyak's step towards a level (the target, if known, or one adapted to
/// the progress).  Five passes over n per step; never proves that it has converged.
MaximizeResult maximize_subgradient(ConcaveFunction& function,
                                    std::span<const double> start,
                                    const MaximizeOptions& options,
                                    const Observer& observer = {});

/// Volume algorithm of Barahona & Anbil (Math. Programming 87, 2000): no master problem, and it
/// averages primal points on the way (Iterate::primal_step); takes more evaluations than the
/// bundle.
MaximizeResult maximize_volume(ConcaveFunction& function,
                               std::span<const double> start,
                               const MaximizeOptions& options,
                               const Observer& observer = {});

/// Block coordinate ascent: a sweep over all blocks counts as one evaluation.  Stops where no block
/// improves, which for a nonsmooth q need not be a maximum.
MaximizeResult maximize_coordinate(CoordinateFunction& function,
                                   std::span<const double> start,
                                   const MaximizeOptions& options,
                                   const Observer& observer = {});

/// The method of that name.  kCoordinate needs a CoordinateFunction.
///
/// All methods throw InputError if an option is out of range, if start has the wrong length or is
/// not finite, and if the function returns something that is not finite.
MaximizeResult maximize(DualMethod method,
                        ConcaveFunction& function,
                        std::span<const double> start,
                        const MaximizeOptions& options,
                        const Observer& observer = {});

}  // namespace nda::dual
