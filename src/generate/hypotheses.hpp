#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "generate/grid.hpp"
#include "generate/portable.hpp"
#include "generate/scenario.hpp"

namespace nda::generate {

/// R of the table below: how far a second detection may be from the first, `gap` scans before.
double second_radius(const TrackingOptions& options, int gap);

/// Gated and scored track hypotheses over the scans, by starting detection.
///
/// A hypothesis is a tuple of detections, one or none of each scan, two or more in all, never more
/// than `max_misses` missing in a row between two of them.  Its cost is -log of a likelihood ratio
/// against false alarms of density f = clutter / L^2, with P = detection_probability, sigma =
/// noise:
///     first detection, in scan s   -log(P b_s / f),  b_0 = targets / L^2,  b_s = b_0 / 10 for s >
///     0 each miss after it           -log(1 - P), after the last detection at most max_misses of
///     them second detection, g scans on -log(P / (pi R^2 f)),  R = g max_speed + 3 sqrt(2) sigma;
///     within R of the first each later detection         -log(P N(nu; 0, S I) / f),  accepted if
///     |nu|^2 / S <= gate
/// gate = -2 log(1 - gate_probability), the quantile of chi^2 with two degrees of freedom.
/// State and covariance start by two-point differencing; then a Kalman filter of constant velocity
/// with white acceleration of spectral density process_noise, the same for both axes; S is a
/// scalar.
class Hypotheses {
 public:
  /// Keeps references to both arguments.
  Hypotheses(const TrackingOptions& options, const std::vector<Scan>& scans);

  /// All hypotheses that start with this detection of this scan, or the `cap` cheapest (ties by
  /// tuple), in lexicographic order.  Throws InputError at more than kMaxPerStart hypotheses, and
  /// where those of all calls have more than kMostEntries indices.
  void enumerate(int scan, std::uint32_t detection);

  std::size_t size() const { return order_.size(); }
  std::span<const Index> tuple(std::size_t h) const {
    return {tuples_.data() + order_[h] * tuple_.size(), tuple_.size()};
  }
  Micro cost(std::size_t h) const { return costs_[order_[h]]; }

  static constexpr std::size_t kMaxPerStart = 2000000;

 private:
  struct State {
    Point position;
    Point velocity;
    double pp, pv, vv;  // covariance of position and velocity, per axis
    double cost;
  };

  void start_track(int scan, Point first, Point second, int gap, double cost);
  void extend(int scan, const State& state);
  void emit(int last_scan, double cost);
  void keep_the_cheapest();

  const TrackingOptions& options_;
  const std::vector<Scan>& scans_;
  std::vector<Grid> grids_;
  double clutter_density_;
  double log_density_ratio_;  // log(P / f)
  double miss_cost_;
  double gate_;

  std::vector<Index> tuple_;   // of the hypothesis in the making
  std::vector<Index> tuples_;  // N entries each
  std::vector<Micro> costs_;
  std::size_t num_emitted_ = 0;       // by all calls
  std::vector<std::uint32_t> order_;  // lexicographic
};

}  // namespace nda::generate
