// The bundle trust method of Schramm & Zowe (A version of the bundle idea for minimizing a
// nonsmooth function, SIAM J. Optim. 2, 1992, 121-152), turned to maximisation.
//
// The idea.  Every evaluation gives a plane above q; their minimum models q.  From the centre c the
// next trial maximises the model minus |d|^2 / (2 t), so t plays the radius of a trust region. With
// v the increase the model predicts, the outcome is judged as in the paper, 0 < m1 < m2 < 1, 0 <
// m3:
//
//   SS(i)   q(c + d) - q(c) >= m1 v   the trial is good: serious step, it becomes the centre;
//   SS(ii)  g'd <= m2 v               and it went far enough: q no longer rises steeply there;
//   NS(i)   not SS(i)                 the trial is bad: null step, the centre stays;
//   NS(ii)  error of g at c <= m3 v,  but the new plane is close to q at c, or q changed by no
//           or q(c) - q(c + d) <= v   more than the model said, so the plane improves the model.
//
// A serious step that fails SS(ii) makes t grow, a null step that fails NS(ii) makes it shrink.
//
// What differs from the paper, each for the sake of the first 10 to 50 evaluations:
// - No evaluation is spent on t alone.  Where SS(ii) or NS(ii) fails, the paper goes back to the
//   old centre with another t and forgets the plane; here the good point and every plane are kept,
//   and the new t counts from the next step on.  Inner and outer iteration fall into one.
// - t changes by the parabola through q(c), the predicted slope v and q(c + d), not by bisection.
// - NS(ii) compares with v, not with norm and error of the last aggregate, which have different
//   units: with that, scaling q or u changes nothing.
// - The second half of NS(ii) counts only near the top, where v is at most a hundredth of the rise
//   so far: before, the planes are too few to be worth more of them at the same t.  And it counts
//   only where |d|^2 / t is a good part of v.  Where it is not, the trial is all but the maximum of
//   the bare model, far out if the planes are few compared with the variables, and a smaller t
//   brings it closer.  Near the top, the first half alone makes t shrink without end along with v,
//   each serious step shorter than the last, and their sum stops short of the maximum.
// - t also grows by a fifth at every second serious step in a row.  Without it, long runs of short
//   serious steps were the rule on tracking problems, each of them fine by SS(i) and SS(ii).
// - Until the first serious step, a trial that falls by a good part of v shrinks t by the parabola
//   whatever its plane: the first t is only a guess, and may be wrong by orders of magnitude.
// - First t: Polyak's, (expected increase) / |g|^2.
// - False convergence.  v is small wherever t is small, so v alone proves nothing.  What proves is
//   q(w) <= q(c) + error + |aggregate| |w - c|, with |w - c| up to the distance that was expected
//   or has been covered.  If v is below the tolerance but this is not, t grows tenfold and the
//   master is solved again, at no evaluation, until the proof is there or the model sees an
//   increase that is worth a trial.
// - It also ends when a null step leaves the master's value as it was: then rounding hides the new
//   plane, and no further trial at this t can be different.
// - t stays between the smallest normal number and 1e200, however small or large q is, and t grows
//   without an evaluation only while the master can be solved and its numbers are finite.  So it
//   ends for functions whose values or subgradients vanish or overflow, too, if with a poor bound.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dual/bundle.hpp"
#include "dual/maximize.hpp"
#include "dual/recorder.hpp"

namespace nda::dual {
namespace {

constexpr double kSerious = 0.1;      // m1
constexpr double kFarEnough = 0.2;    // m2
constexpr double kCloseEnough = 0.7;  // m3
constexpr double kNearTop = 0.01;     // v as a part of the rise so far
constexpr double kGoodPart = 0.05;    // |d|^2 / t as a part of v
constexpr double kMostGrowth = 10;
constexpr double kMostShrinkage = 0.1;  // before the first serious step
constexpr double kShrinkage = 0.5;      // afterwards
constexpr double kFall = 0.3;           // part of v
constexpr double kRunGrowth = 1.2;
constexpr int kRun = 2;  // serious steps
constexpr double kLeastStep = std::numeric_limits<double>::min();
constexpr double kMostStep = 1e200;
/// Added to the error of a plane, relative to its terms, so that the plane stays above q.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

class BundleTrust {
 public:
  BundleTrust(ConcaveFunction& function,
              std::span<const double> start,
              const MaximizeOptions& options,
              const Observer& observer);
  MaximizeResult run();

 private:
  void evaluate_start();
  bool find_trial();
  void try_trial();
  void accept(double value, double slope, double predicted);
  void reject(double increase, double error, double predicted);
  bool proved() const;
  bool stalled() const;
  bool improves_model(double increase, double error, double predicted) const;

  MaximizeOptions options_;
  std::span<const double> start_;
  Recorder recorder_;
  Bundle bundle_;
  std::vector<double> centre_;
  std::vector<double> trial_;
  double centre_value_ = 0;
  double step_ = 1;        // t
  double radius_ = 0;      // first step, or farthest centre from the start
  double null_value_ = 0;  // value of the master before the last null step
  int null_steps_ = 0;     // since the last serious step or change of t
  int run_ = 0;            // serious steps in a row that t did not react to
  bool any_serious_ = false;
};

std::size_t capacity(const MaximizeOptions& options) {
  return static_cast<std::size_t>(
      std::min(options.bundle_size, std::max(2, options.max_evaluations)));
}

// The peak, as a multiple of the step, of the parabola with slope `predicted` at the centre that
// rises by `increase` over the step.
double parabola_peak(double predicted, double increase) {
  const double bend = 2 * (predicted - increase);
  return bend > 0 ? predicted / bend : std::numeric_limits<double>::infinity();
}

double distance(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

BundleTrust::BundleTrust(ConcaveFunction& function,
                         std::span<const double> start,
                         const MaximizeOptions& options,
                         const Observer& observer)
    : options_(options),
      start_(start),
      recorder_(function, start, options, observer),
      bundle_(start.size(),
              capacity(options),
              options.primal_weights ? static_cast<std::size_t>(options.max_evaluations) : 0),
      centre_(start.begin(), start.end()),
      trial_(start.size()) {}

void BundleTrust::evaluate_start() {
  centre_value_ = recorder_.evaluate(centre_, bundle_.candidate());
  bundle_.measure_candidate();
  bundle_.insert_candidate(0, recorder_.evaluations());
  bundle_.solve(1);
  const double norm2 = bundle_.aggregate_norm2();
  if (options_.initial_step > 0) {
    step_ = options_.initial_step;
  } else if (norm2 > 0) {
    step_ = recorder_.expected_increase() / norm2;
  }
  step_ = std::clamp(step_, kLeastStep, kMostStep);
  radius_ = recorder_.expected_distance();
  recorder_.report(centre_, centre_value_, true);
}

bool BundleTrust::proved() const {
  const double norm = std::sqrt(bundle_.aggregate_norm2());
  return bundle_.aggregate_error() + norm * radius_ <= recorder_.tolerance();
}

bool BundleTrust::stalled() const {
  return null_steps_ > 0 && bundle_.master_value() >= null_value_;
}

// Solves the master for the next trial; false if there is none worth an evaluation.
bool BundleTrust::find_trial() {
  for (;;) {
    const bool solved = bundle_.solve(step_);
    if (proved() || stalled()) return false;
    null_value_ = bundle_.master_value();
    const double predicted = bundle_.predicted_increase();
    if (!std::isfinite(predicted)) return false;
    if (predicted > 0 && predicted > recorder_.tolerance()) return true;
    if (!solved || step_ > kMostStep) return false;
    step_ *= kMostGrowth;
    null_steps_ = 0;
  }
}

void BundleTrust::accept(double value, double slope, double predicted) {
  const double increase = value - centre_value_;
  bundle_.move_centre(increase);
  bundle_.insert_candidate(0, recorder_.evaluations());
  std::swap(centre_, trial_);
  centre_value_ = value;
  radius_ = std::max(radius_, distance(centre_, start_));
  any_serious_ = true;
  null_steps_ = 0;
  if (slope > kFarEnough * predicted) {
    step_ *= std::clamp(parabola_peak(predicted, increase), 1.0, kMostGrowth);
    run_ = 0;
  } else if (++run_ == kRun) {
    step_ *= kRunGrowth;
    run_ = 0;
  }
}

// NS(ii).
bool BundleTrust::improves_model(double increase, double error, double predicted) const {
  if (error <= kCloseEnough * predicted) return true;
  const bool near_top = predicted <= kNearTop * (centre_value_ - recorder_.first_value());
  const bool restrained = predicted - bundle_.aggregate_error() >= kGoodPart * predicted;
  return near_top && restrained && -increase <= predicted;
}

void BundleTrust::reject(double increase, double error, double predicted) {
  bundle_.insert_candidate(error, recorder_.evaluations());
  run_ = 0;
  ++null_steps_;
  double factor = 1;
  if (!any_serious_ && increase < -kFall * predicted) {
    factor = std::clamp(parabola_peak(predicted, increase), kMostShrinkage, 1.0);
  } else if (!improves_model(increase, error, predicted)) {
    factor = kShrinkage;
  }
  const double step = std::max(kLeastStep, factor * step_);
  if (step == step_) return;
  step_ = step;
  null_steps_ = 0;
}

void BundleTrust::try_trial() {
  const double predicted = bundle_.predicted_increase();
  const std::span<const double> aggregate = bundle_.aggregate();
  for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = centre_[i] + step_ * aggregate[i];
  const double value = recorder_.evaluate(trial_, bundle_.candidate());
  bundle_.measure_candidate();
  const double increase = value - centre_value_;
  const double slope = bundle_.candidate_slope();
  const double rounding = kRounding * (std::abs(value) + bundle_.candidate_reach());
  const bool serious = increase > 0 && increase >= kSerious * predicted;
  if (serious) {
    accept(value, slope, predicted);
  } else {
    reject(increase, increase - slope + rounding, predicted);
  }
  recorder_.report(serious ? centre_ : trial_, value, serious);
}

MaximizeResult BundleTrust::run() {
  evaluate_start();
  while (!recorder_.stopped() && find_trial()) try_trial();
  MaximizeResult result = recorder_.finish();
  result.aggregate_norm = std::sqrt(bundle_.aggregate_norm2());
  result.aggregate_error = bundle_.aggregate_error();
  result.step = step_;
  result.primal_weights = bundle_.primal_weights();
  return result;
}

}  // namespace

MaximizeResult maximize_bundle_trust(ConcaveFunction& function,
                                     std::span<const double> start,
                                     const MaximizeOptions& options,
                                     const Observer& observer) {
  return BundleTrust(function, start, options, observer).run();
}

}  // namespace nda::dual
