// The subgradient method, with Polyak's step towards a level.
//
// Polyak (USSR Comp. Math. 9, 1969) steps by (q* - q(u)) / |g|^2 along g.  The optimum q* being
// unknown, a level above the best value stands for it, and the gap between the two is adapted as in
// the path-based rule of Brannlund (1993), convergence proved by Goffin & Kiwiel (Math. Programming
// 85, 1999): the gap is kept while the best value rises by a good part of it, and halved when the
// steps since the last such rise have covered a path longer than a bound without one.
//
// Different from there: a rise that comes at once doubles the gap, so a first guess that is too
// small costs only its logarithm; the path bound is not given but a number of first steps; and a
// known target caps the level.
#include <algorithm>
#include <cmath>

#include "dual/maximize.hpp"
#include "dual/recorder.hpp"

namespace nda::dual {
namespace {

constexpr double kFirstGap = 0.25;  // of the expected increase
constexpr double kRise = 0.5;       // a rise of this part of the gap confirms it
constexpr int kQuickRise = 3;       // steps; sooner than this, the gap was too small
constexpr double kPathSteps = 3;    // path allowed without a rise, in first steps of the phase

class Subgradient {
 public:
  Subgradient(ConcaveFunction& function,
              std::span<const double> start,
              const MaximizeOptions& options,
              const Observer& observer)
      : target_(options.target),
        recorder_(function, start, options, observer),
        point_(start.begin(), start.end()),
        subgradient_(start.size()) {}

  MaximizeResult run();

 private:
  void evaluate();
  void adapt_gap();
  void begin_phase();
  bool step();

  double target_;
  Recorder recorder_;
  std::vector<double> point_;
  std::vector<double> subgradient_;
  double value_ = 0;
  double norm_ = 0;
  double gap_ = 0;
  double phase_value_ = 0;  // best value when the phase began
  double path_ = 0;         // length of the steps of the phase
  double path_limit_ = 0;
  int phase_steps_ = 0;
};

void Subgradient::evaluate() {
  const double best = recorder_.best_value();
  value_ = recorder_.evaluate(point_, subgradient_);
  double norm2 = 0;
  for (const double g : subgradient_) norm2 += g * g;
  norm_ = std::sqrt(norm2);
  recorder_.report(point_, value_, value_ > best);
}

void Subgradient::begin_phase() {
  phase_value_ = recorder_.best_value();
  phase_steps_ = 0;
  path_ = 0;
  path_limit_ = 0;
}

void Subgradient::adapt_gap() {
  if (recorder_.best_value() >= phase_value_ + kRise * gap_) {
    if (phase_steps_ <= kQuickRise) gap_ *= 2;
    begin_phase();
  } else if (phase_steps_ > 0 && path_ > path_limit_) {
    gap_ /= 2;
    begin_phase();
  }
}

// False when the subgradient vanishes, so that the point is optimal, or the gap has closed.
bool Subgradient::step() {
  const double level = std::min(target_, recorder_.best_value() + gap_);
  if (norm_ == 0 || gap_ <= recorder_.tolerance()) return false;
  const double length = (level - value_) / norm_;
  for (std::size_t i = 0; i < point_.size(); ++i) point_[i] += length / norm_ * subgradient_[i];
  if (phase_steps_++ == 0) path_limit_ = kPathSteps * length;
  path_ += length;
  return true;
}

MaximizeResult Subgradient::run() {
  evaluate();
  gap_ = kFirstGap * recorder_.expected_increase();
  begin_phase();
  while (!recorder_.stopped() && step()) {
    evaluate();
    adapt_gap();
  }
  return recorder_.finish();
}

}  // namespace

MaximizeResult maximize_subgradient(ConcaveFunction& function,
                                    std::span<const double> start,
                                    const MaximizeOptions& options,
                                    const Observer& observer) {
  return Subgradient(function, start, options, observer).run();
}

}  // namespace nda::dual
