#include "generate/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

// Depth-first over the scans: from its last detection a track goes on to every detection inside its
// gate in the next max_misses + 1 scans.  The covariance depends on the pattern of misses alone,
// the gates are discs because both axes have the same, and a grid per scan finds what is inside.
// Everything about one starting detection is collected, cut to the cheapest and sorted before the
// next one, so memory stays small and the arcs come out in lexicographic order.

namespace nda::generate {
namespace {

double gate_cell(const TrackingOptions& options) {
  return options.max_speed + options.noise;
}

}  // namespace

double second_radius(const TrackingOptions& options, int gap) {
  return gap * options.max_speed + 3 * std::sqrt(2.0) * options.noise;
}

Hypotheses::Hypotheses(const TrackingOptions& options, const std::vector<Scan>& scans)
    : options_(options), scans_(scans), tuple_(scans.size(), 0) {
  for (const Scan& scan : scans) grids_.emplace_back(scan, gate_cell(options));
  clutter_density_ = options.clutter / (options.side * options.side);
  log_density_ratio_ = natural_log(options.detection_probability / clutter_density_);
  miss_cost_ = -natural_log(1 - options.detection_probability);
  gate_ = -2 * natural_log(1 - options.gate_probability);
}

void Hypotheses::enumerate(int scan, std::uint32_t detection) {
  tuples_.clear();
  costs_.clear();
  const Point first = scans_[static_cast<std::size_t>(scan)][detection];
  const double targets = options_.targets / (options_.side * options_.side);
  const double birth_density = scan == 0 ? targets : targets / 10;
  const double cost = -natural_log(birth_density) - log_density_ratio_;
  tuple_[static_cast<std::size_t>(scan)] = detection + 1;
  for (int gap = 1; gap <= options_.max_misses + 1 && scan + gap < options_.scans; ++gap) {
    const std::size_t next = static_cast<std::size_t>(scan + gap);
    const double radius = second_radius(options_, gap);
    const double second_cost = natural_log(kPi * radius * radius) - log_density_ratio_;
    grids_[next].for_each_within(first, radius, [&](std::uint32_t j, double) {
      tuple_[next] = j + 1;
      start_track(
          scan + gap, first, scans_[next][j], gap, cost + (gap - 1) * miss_cost_ + second_cost);
    });
    tuple_[next] = 0;
  }
  tuple_[static_cast<std::size_t>(scan)] = 0;
  keep_the_cheapest();
}

void Hypotheses::start_track(int scan, Point first, Point second, int gap, double cost) {
  const double variance = options_.noise * options_.noise;
  State state;
  state.position = second;
  state.velocity = {(second.x - first.x) / gap, (second.y - first.y) / gap};
  state.pp = variance;
  state.pv = variance / gap;
  state.vv = 2 * variance / (gap * gap);
  state.cost = cost;
  extend(scan, state);
}

void Hypotheses::extend(int scan, const State& state) {
  emit(scan, state.cost);
  State predicted = state;
  const double q = options_.process_noise;
  for (int gap = 1; gap <= options_.max_misses + 1 && scan + gap < options_.scans; ++gap) {
    const std::size_t next = static_cast<std::size_t>(scan + gap);
    predicted.position.x += state.velocity.x;
    predicted.position.y += state.velocity.y;
    predicted.pp += 2 * predicted.pv + predicted.vv + q / 3;
    predicted.pv += predicted.vv + q / 2;
    predicted.vv += q;
    const double s = predicted.pp + options_.noise * options_.noise;
    const double position_gain = predicted.pp / s;
    const double velocity_gain = predicted.pv / s;
    const double fixed =
        state.cost + (gap - 1) * miss_cost_ - log_density_ratio_ + natural_log(2 * kPi * s);
    grids_[next].for_each_within(
        predicted.position, std::sqrt(gate_ * s), [&](std::uint32_t j, double squared) {
          const Point seen = scans_[next][j];
          const double nu_x = seen.x - predicted.position.x;
          const double nu_y = seen.y - predicted.position.y;
          State updated;
          updated.position = {predicted.position.x + position_gain * nu_x,
                              predicted.position.y + position_gain * nu_y};
          updated.velocity = {predicted.velocity.x + velocity_gain * nu_x,
                              predicted.velocity.y + velocity_gain * nu_y};
          updated.pp = predicted.pp - position_gain * predicted.pp;
          updated.pv = predicted.pv - position_gain * predicted.pv;
          updated.vv = predicted.vv - velocity_gain * predicted.pv;
          updated.cost = fixed + squared / (2 * s);
          tuple_[next] = j + 1;
          extend(scan + gap, updated);
        });
    tuple_[next] = 0;
  }
}

void Hypotheses::emit(int last_scan, double cost) {
  const std::size_t most = static_cast<std::size_t>(kMostEntries) / tuple_.size();
  if (costs_.size() == kMaxPerStart || ++num_emitted_ > most) {
    const bool of_one = costs_.size() == kMaxPerStart;
    throw InputError("more than " + std::to_string(of_one ? kMaxPerStart : most) + " hypotheses" +
                     (of_one ? " start with one detection" : "") +
                     ": fewer targets, scans or misses, less noise, or a larger side");
  }
  const int trailing = std::min(options_.scans - 1 - last_scan, options_.max_misses);
  costs_.push_back(to_micro(cost + trailing * miss_cost_));
  tuples_.insert(tuples_.end(), tuple_.begin(), tuple_.end());
}

void Hypotheses::keep_the_cheapest() {
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    const Index* x = tuples_.data() + a * tuple_.size();
    const Index* y = tuples_.data() + b * tuple_.size();
    return std::lexicographical_compare(x, x + tuple_.size(), y, y + tuple_.size());
  };
  order_.resize(costs_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  const std::size_t cap = static_cast<std::size_t>(options_.cap);
  if (cap > 0 && cap < order_.size()) {
    std::nth_element(order_.begin(),
                     order_.begin() + options_.cap,
                     order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return costs_[a] != costs_[b] ? costs_[a] < costs_[b] : compare(a, b);
                     });
    order_.resize(cap);
  }
  std::sort(order_.begin(), order_.end(), compare);
}

}  // namespace nda::generate
