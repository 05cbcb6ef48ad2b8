// draft
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dual/bundle.hpp"
#include "dual/maximize.hpp"
#include "dual/recorder.hpp"

namespace nda::dual {

struct TrustTuning {
  double serious = 0.1;    // m1
  double too_short = 0.5;  // m2
  double m3 = 0.5;
  double grow_max = 10;
  double shrink_min = 0.1;
  double first = 1.0;  // fraction of expected
  int mode = 0;
  int null_shrink_after = 0;
  double extra = 0;
  bool verbose = false;
};
TrustTuning tuning;

namespace {

class BundleTrust {
 public:
  BundleTrust(ConcaveFunction& function,
              std::span<const double> start,
              const MaximizeOptions& options,
              const Observer& observer)
      : options_(options),
        start_(start),
        recorder_(function, start, options, observer),
        bundle_(start.size(),
                static_cast<std::size_t>(
                    std::min(options.bundle_size, std::max(2, options.max_evaluations))),
                options.primal_weights ? static_cast<std::size_t>(options.max_evaluations) : 0),
        centre_(start.begin(), start.end()),
        trial_(start.size()) {}

  MaximizeResult run() {
    evaluate_start();
    while (!recorder_.stopped() && propose()) try_step();
    std::vector<double> w = bundle_.primal_weights();
    MaximizeResult result = recorder_.finish();
    result.aggregate_error = bundle_.aggregate_error();
    result.aggregate_norm = std::sqrt(bundle_.aggregate_norm2());
    result.primal_weights = std::move(w);
    result.step = step_;
    return result;
  }

 private:
  void evaluate_start() {
    centre_value_ = recorder_.evaluate(centre_, bundle_.candidate());
    bundle_.measure_candidate();
    bundle_.insert_candidate(0, 1);
    bundle_.solve(1);
    const double norm2 = bundle_.aggregate_norm2();
    step_ = options_.initial_step > 0 ? options_.initial_step
            : norm2 > 0 ? tuning.first * recorder_.expected_increase(std::sqrt(norm2)) / norm2
                        : 1.0;
    radius_ = step_ * std::sqrt(norm2);
    recorder_.report(centre_, centre_value_, true);
  }

  bool converged() const {
    return bundle_.aggregate_error() + std::sqrt(bundle_.aggregate_norm2()) * radius_ <=
           recorder_.tolerance();
  }

  bool propose() {
    for (;;) {
      bundle_.solve(step_);
      if (converged()) return false;
      if (bundle_.predicted_increase() > recorder_.tolerance() && bundle_.predicted_increase() > 0)
        return true;
      if (!(step_ < 1e100)) return false;
      step_ *= 10;
    }
  }

  void try_step() {
    const double t = bundle_.step();
    const double v = bundle_.predicted_increase();
    const std::span<const double> g = bundle_.aggregate();
    for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = centre_[i] + t * g[i];
    const double value = recorder_.evaluate(trial_, bundle_.candidate());
    radius_ = std::max(radius_, t * std::sqrt(bundle_.aggregate_norm2()));
    bundle_.measure_candidate();
    const double increase = value - centre_value_;
    const double slope = bundle_.candidate_slope();
    const double error = increase - slope;
    const bool serious = increase > 0 && increase >= tuning.serious * v;
    if (tuning.verbose)
      std::printf(
          "%3d t %.3g v %.4g (t|g|2 %.4g err %.4g) inc %.4g slope %.4g alpha %.4g %s  q %.10g\n",
          recorder_.evaluations(),
          t,
          v,
          t * bundle_.aggregate_norm2(),
          bundle_.aggregate_error(),
          increase,
          slope,
          error,
          serious ? "S" : "-",
          value);
    const double factor = v / (2 * (v - increase));  // of the parabola, if positive
    if (serious) {
      bundle_.move_centre(increase);
      bundle_.insert_candidate(0, recorder_.evaluations());
      std::swap(centre_, trial_);
      centre_value_ = value;
      nulls_ = 0;
      ++serious_in_row_;
      if (slope > tuning.too_short * v || increase >= v) {
        step_ *= increase >= v * 0.95 ? tuning.grow_max : std::clamp(factor, 1.0, tuning.grow_max);
      }
      recorder_.report(centre_, value, true);
    } else {
      ++nulls_;
      serious_in_row_ = 0;
      bundle_.insert_candidate(error, recorder_.evaluations());
      if (nulls_ > tuning.null_shrink_after &&
          error > tuning.m3 * std::max(v, bundle_.aggregate_error() + tuning.extra * v)) {
        step_ *= std::clamp(factor, tuning.shrink_min, 1.0);
      }
      recorder_.report(trial_, value, false);
    }
  }

  MaximizeOptions options_;
  std::span<const double> start_;
  Recorder recorder_;
  Bundle bundle_;
  std::vector<double> centre_;
  std::vector<double> trial_;
  double centre_value_ = 0;
  double step_ = 1;
  double max_step_ = 1;
  double radius_ = 0;
  int nulls_ = 0;
  int serious_in_row_ = 0;
};

}  // namespace

MaximizeResult maximize_bundle_trust(ConcaveFunction& function,
                                     std::span<const double> start,
                                     const MaximizeOptions& options,
                                     const Observer& observer) {
  return BundleTrust(function, start, options, observer).run();
}

}  // namespace nda::dual
