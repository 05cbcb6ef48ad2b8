#include "dual/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "nda/types.hpp"

namespace nda::dual {
namespace {

/// Relative accuracy that no method tries to exceed.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

[[noreturn]] void fail(const std::string& what, double value) {
  throw InputError(what + " is " + std::to_string(value));
}

void require_finite(std::span<const double> values, const std::string& what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) fail(what + " entry " + std::to_string(i + 1), values[i]);
  }
}

}  // namespace

void validate(const MaximizeOptions& options) {
  if (options.max_evaluations < 1)
    fail("max_evaluations must be >= 1, it", options.max_evaluations);
  if (!(options.relative_tolerance >= 0)) {
    fail("relative_tolerance must be >= 0, it", options.relative_tolerance);
  }
  if (std::isnan(options.target)) fail("target must be a number, it", options.target);
  if (options.bundle_size < 2) fail("bundle_size must be >= 2, it", options.bundle_size);
  if (!(options.expected_increase >= 0) || !std::isfinite(options.expected_increase)) {
    fail("expected_increase must be >= 0 and finite, it", options.expected_increase);
  }
  if (!(options.initial_step >= 0) || !std::isfinite(options.initial_step)) {
    fail("initial_step must be >= 0 and finite, it", options.initial_step);
  }
  if (!(options.volume.first_alpha > 0 && options.volume.first_alpha <= 1)) {
    fail("volume.first_alpha must be in (0, 1], it", options.volume.first_alpha);
  }
  if (options.volume.patience < 1)
    fail("volume.patience must be >= 1, it", options.volume.patience);
}

Recorder::Recorder(ConcaveFunction& function,
                   std::span<const double> start,
                   const MaximizeOptions& options,
                   const Observer& observer)
    : function_(&function), options_(options), observer_(&observer) {
  validate(options);
  if (start.size() != function.num_variables()) {
    throw InputError("start has " + std::to_string(start.size()) + " entries, the function " +
                     std::to_string(function.num_variables()) + " variables");
  }
  require_finite(start, "start");
  result_.point.assign(start.begin(), start.end());
}

double Recorder::evaluate(std::span<const double> u, std::span<double> subgradient) {
  const double value = function_->evaluate(u, subgradient);
  ++result_.evaluations;
  const std::string place = "evaluation " + std::to_string(result_.evaluations) + ": ";
  if (!std::isfinite(value)) fail(place + "q", value);
  require_finite(subgradient, place + "subgradient");
  if (result_.evaluations == 1) {
    first_value_ = value;
    set_expectations(subgradient);
  }
  return value;
}

// Without any hint, q itself sets the scale: a dual function starts at a sum of costs.
void Recorder::set_expectations(std::span<const double> subgradient) {
  double norm = 0;
  for (const double g : subgradient) norm = std::hypot(norm, g);
  if (options_.expected_increase > 0) {
    expected_increase_ = options_.expected_increase;
  } else if (std::isfinite(options_.target) && options_.target > first_value_) {
    expected_increase_ = options_.target - first_value_;
  } else {
    expected_increase_ = first_value_ != 0 ? std::abs(first_value_) : norm;
  }
  if (norm > 0) expected_distance_ = expected_increase_ / norm;
}

void Recorder::report(std::span<const double> u, double value, bool serious, double primal_step) {
  if (value > result_.value) {
    result_.value = value;
    std::copy(u.begin(), u.end(), result_.point.begin());
  }
  if (serious && result_.evaluations > 1) ++result_.serious_steps;
  const Iterate iterate{result_.evaluations, value, result_.value, u, serious, primal_step};
  if (result_.evaluations >= options_.max_evaluations) reason_ = StopReason::kEvaluationLimit;
  if (*observer_ && !(*observer_)(iterate)) reason_ = StopReason::kObserver;
  if (result_.value >= options_.target) reason_ = StopReason::kTargetReached;
}

double Recorder::tolerance() const {
  const double scale = std::max(std::abs(result_.value), result_.value - first_value_);
  return std::max(options_.relative_tolerance * scale,
                  kRounding * std::max(scale, expected_increase_));
}

MaximizeResult Recorder::finish() {
  result_.reason = reason_.value_or(StopReason::kConverged);
  return std::move(result_);
}

}  // namespace nda::dual
