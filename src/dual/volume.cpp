// The volume algorithm of Barahona & Anbil (Math. Programming 87, 2000, 385-399).
//
// A subgradient method from a centre (the best point) along an average v of the subgradients seen,
// v = alpha g + (1 - alpha) v.  The weights with which a subgradient enters v estimate the volumes
// below the faces of q, and by linear programming duality the same average of the primal points
// tends to a primal optimum; Iterate::primal_step hands out alpha.
//
// As in the paper: alpha minimises |alpha g + (1 - alpha) v| between a tenth of its upper limit and
// that limit, which is halved when the value stalls; step = f (T - q) / |v|^2; f shrinks after red
// steps (no increase) and grows after a green one (increase, and g'v >= 0).
// Different: targets T are measured from q(start), not from 0, so that adding a constant to q
// changes nothing, and doubled rather than raised by 5 % when reached; f loses a third at every red
// step, not after 20 of them, and has no floor; the limit of alpha starts at 0.8, not 0.1, and is
// tried against the last 50 evaluations, not 100.  The paper has thousands of steps in mind, here
// they are hundreds, and T is only a guess.  Who begins near the maximum and wants the average is
// nearer to the paper: VolumeSteps.  Should the average vanish while its linearisation
// error does not, it starts again from the last subgradient.  The run ends when that error and the
// norm of the average times the distance covered are both small, the test of the bundle method.
#include <algorithm>
#include <cmath>

#include "dual/maximize.hpp"
#include "dual/recorder.hpp"

namespace nda::dual {
namespace {

constexpr double kLeastLimit = 1e-5;  // of alpha
constexpr int kLimitPeriod = 50;      // evaluations between trials of the limit
constexpr double kLimitRise = 0.01;   // a relative rise in such a period that keeps it
constexpr double kFirstFactor = 0.5;  // f
constexpr double kMostFactor = 2;
constexpr double kGreen = 1.1;
constexpr double kRed = 0.66;
constexpr double kNearTarget = 0.95;

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

class Volume {
 public:
  Volume(ConcaveFunction& function,
         std::span<const double> start,
         const MaximizeOptions& options,
         const Observer& observer)
      : options_(options),
        recorder_(function, start, options, observer),
        start_(start),
        centre_(start.begin(), start.end()),
        trial_(start.size()),
        subgradient_(start.size()),
        average_(start.size()) {
    if (options.primal_weights) weights_.resize(static_cast<std::size_t>(options.max_evaluations));
  }

  MaximizeResult run();

 private:
  void evaluate_start();
  void step();
  double best_alpha() const;
  void average(double alpha, double error);
  void accept(double value);
  void adapt_factor(bool improved, double slope);
  void adapt_limit();
  void adapt_target();
  bool converged() const;

  MaximizeOptions options_;
  Recorder recorder_;
  std::span<const double> start_;
  std::vector<double> centre_;
  std::vector<double> trial_;
  std::vector<double> subgradient_;
  std::vector<double> average_;  // v
  std::vector<double> weights_;
  double centre_value_ = 0;
  double error_ = 0;   // linearisation error of v at the centre
  double norm2_ = 0;   // |v|^2
  double radius_ = 0;  // expected distance, or farthest centre from the start
  double rise_ = 0;    // T - q(start)
  double factor_ = kFirstFactor;
  double limit_ = options_.volume.first_alpha;
  int reds_ = 0;            // red steps since f was changed
  double limit_value_ = 0;  // q(centre) when limit_ was last tried
};

void Volume::evaluate_start() {
  centre_value_ = recorder_.evaluate(centre_, average_);
  if (!weights_.empty()) weights_[0] = 1;
  norm2_ = dot(average_, average_);
  rise_ = recorder_.expected_increase();
  radius_ = recorder_.expected_distance();
  limit_value_ = centre_value_;
  recorder_.report(centre_, centre_value_, true, 1);
}

// The minimiser of |alpha g + (1 - alpha) v|, kept within its limits.
double Volume::best_alpha() const {
  const double g_norm2 = dot(subgradient_, subgradient_);
  const double product = dot(subgradient_, average_);
  const double curvature = g_norm2 - 2 * product + norm2_;
  const double alpha = curvature > 0 ? (norm2_ - product) / curvature : limit_;
  return std::clamp(alpha, limit_ / 10, limit_);
}

void Volume::average(double alpha, double error) {
  for (std::size_t i = 0; i < average_.size(); ++i) {
    average_[i] += alpha * (subgradient_[i] - average_[i]);
  }
  norm2_ = dot(average_, average_);
  error_ += alpha * (error - error_);
  for (double& w : weights_) w *= 1 - alpha;
  if (!weights_.empty()) weights_[static_cast<std::size_t>(recorder_.evaluations()) - 1] += alpha;
}

void Volume::accept(double value) {
  std::swap(centre_, trial_);
  centre_value_ = value;
  double distance2 = 0;
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    distance2 += (centre_[i] - start_[i]) * (centre_[i] - start_[i]);
  }
  radius_ = std::max(radius_, std::sqrt(distance2));
}

void Volume::adapt_factor(bool improved, double slope) {
  if (improved) {
    reds_ = 0;
    if (slope >= 0) factor_ = std::min(kMostFactor, factor_ * kGreen);
  } else if (++reds_ >= options_.volume.patience) {
    reds_ = 0;
    factor_ *= kRed;
  }
}

void Volume::adapt_limit() {
  if (recorder_.evaluations() % kLimitPeriod != 0) return;
  const double risen = centre_value_ - recorder_.first_value();
  if (centre_value_ - limit_value_ < kLimitRise * risen) limit_ = std::max(kLeastLimit, limit_ / 2);
  limit_value_ = centre_value_;
}

void Volume::adapt_target() {
  if (std::isfinite(options_.target)) return;
  const double risen = centre_value_ - recorder_.first_value();
  if (risen >= kNearTarget * rise_) rise_ *= 2;
}

void Volume::step() {
  const double gap = recorder_.first_value() + rise_ - centre_value_;
  const double length = factor_ * std::max(gap, recorder_.tolerance()) / norm2_;
  for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = centre_[i] + length * average_[i];
  const double value = recorder_.evaluate(trial_, subgradient_);
  const double increase = value - centre_value_;
  const double slope = length * dot(subgradient_, average_);
  const bool improved = increase > 0;
  double error = increase - slope;
  if (improved) {
    error_ = std::max(0.0, error_ + length * norm2_ - increase);
    error = 0;
    accept(value);
  }
  double alpha = best_alpha();
  average(alpha, std::max(0.0, error));
  if (norm2_ == 0 && error_ > recorder_.tolerance()) {
    alpha = 1;
    average(alpha, std::max(0.0, error));
  }
  adapt_factor(improved, slope);
  adapt_limit();
  adapt_target();
  recorder_.report(improved ? centre_ : trial_, value, improved, alpha);
}

bool Volume::converged() const {
  return norm2_ == 0 || error_ + std::sqrt(norm2_) * radius_ <= recorder_.tolerance();
}

MaximizeResult Volume::run() {
  evaluate_start();
  while (!recorder_.stopped() && !converged()) step();
  MaximizeResult result = recorder_.finish();
  result.aggregate_norm = std::sqrt(norm2_);
  result.aggregate_error = error_;
  result.primal_weights = std::move(weights_);
  return result;
}

}  // namespace

MaximizeResult maximize_volume(ConcaveFunction& function,
                               std::span<const double> start,
                               const MaximizeOptions& options,
                               const Observer& observer) {
  return Volume(function, start, options, observer).run();
}

}  // namespace nda::dual
