#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dual/maximize.hpp"

namespace nda::dual {

/// What all maximisers share: it evaluates, checks what comes back, keeps the best point, informs
/// the observer, and knows when to stop for a reason that is not convergence.
class Recorder {
 public:
  /// Throws InputError on bad options or a bad start.
  Recorder(ConcaveFunction& function,
           std::span<const double> start,
           const MaximizeOptions& options,
           const Observer& observer);

  /// q(u) and a supergradient; InputError if one is not finite.  Call report() before the next.
  double evaluate(std::span<const double> u, std::span<double> subgradient);

  /// Ends the evaluation of `u`: q there was `value`.
  void report(std::span<const double> u, double value, bool serious, double primal_step = 0);

  /// The limit, the target or the observer ends the run.
  bool stopped() const { return reason_.has_value(); }

  int evaluations() const { return result_.evaluations; }
  double best_value() const { return result_.value; }
  double first_value() const { return first_value_; }
  std::span<const double> best_point() const { return result_.point; }

  /// Guess of max q - q(start) from the options, the first value and |g| there; > 0 where g is not
  /// 0.
  double expected_increase() const { return expected_increase_; }

  /// How far the maximum may be from the start, as a guess: expected increase / |g|.
  double expected_distance() const { return expected_distance_; }

  /// relative_tolerance * S, see MaximizeOptions, but no less than rounding.
  double tolerance() const;

  /// The answer; kConverged unless stopped().  Leaves the recorder empty.
  MaximizeResult finish();

 private:
  void set_expectations(std::span<const double> subgradient);

  ConcaveFunction* function_;
  MaximizeOptions options_;
  const Observer* observer_;
  double first_value_ = 0;
  double expected_increase_ = 0;
  double expected_distance_ = 0;
  std::optional<StopReason> reason_;
  MaximizeResult result_;
};

}  // namespace nda::dual
