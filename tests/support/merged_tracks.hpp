#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "nda/problem.hpp"

namespace nda::support {

/// Tracks and the measurements of the next scans, where targets that are near one another give one
/// measurement together.
struct MergedTracksOptions {
  int tracks = 50;
  int scans = 3;
  double spacing = 3;     ///< mean distance of targets, in standard deviations of a measurement
  double resolution = 1;  ///< nearer ones merge, each scan anew
  std::size_t arcs_per_track = 60;  ///< the cheapest are kept
  std::uint64_t seed = 1;
};

/// Dimension 1 has the tracks, each used once; the others have the measurements of a scan: of two
/// targets 1..2, else once.  Costs are negative log likelihood ratios, to three digits.
class MergedTracks {
 public:
  explicit MergedTracks(const MergedTracksOptions& options)
      : options_(options), random_(options.seed) {}

  Problem make() {
    const double side = options_.spacing * std::sqrt(static_cast<double>(options_.tracks));
    for (int t = 0; t < options_.tracks; ++t)
      targets_.push_back({random_.uniform(0, side), random_.uniform(0, side)});
    for (int s = 0; s < options_.scans; ++s) measure(side);
    ProblemBuilder builder(sizes());
    for (Index t = 1; t <= targets_.size(); ++t) add_track(builder, t);
    for (int s = 0; s < options_.scans; ++s) {
      const auto& scan = scans_[static_cast<std::size_t>(s)];
      for (Index z = 1; z <= scan.size(); ++z) {
        if (scan[z - 1].is_merged) builder.set_use_bounds(s + 1, z, {1, 2});
      }
    }
    return std::move(builder).build();
  }

 private:
  struct Point {
    double x;
    double y;
  };
  struct Measurement {
    Point at;
    bool is_merged;
  };
  struct Hypothesis {
    double cost;
    std::vector<Index> tuple;
  };

  static constexpr double kMissed = 3;
  static constexpr double kDetected = -2;
  static constexpr double kGate = 9;
  static constexpr double kDetection = 0.9;
  static constexpr double kClutterShare = 0.2;

  double noise() {  // roughly normal
    double sum = -6;
    for (int n = 0; n < 12; ++n) sum += random_.uniform();
    return sum;
  }

  void measure(double side) {
    std::vector<Measurement> scan;
    std::vector<bool> seen(targets_.size(), false);
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      if (seen[t]) continue;
      std::size_t partner = targets_.size();
      for (std::size_t o = t + 1; o < targets_.size(); ++o) {
        const double dx = targets_[o].x - targets_[t].x;
        const double dy = targets_[o].y - targets_[t].y;
        if (!seen[o] && dx * dx + dy * dy < options_.resolution * options_.resolution) partner = o;
      }
      const bool is_merged = partner < targets_.size();
      if (is_merged) seen[partner] = true;
      if (random_.uniform() > kDetection) continue;
      Point at = targets_[t];
      if (is_merged) {
        at.x = (at.x + targets_[partner].x) / 2;
        at.y = (at.y + targets_[partner].y) / 2;
      }
      scan.push_back({{at.x + noise(), at.y + noise()}, is_merged});
    }
    const auto clutter = static_cast<std::size_t>(kClutterShare * options_.tracks);
    for (std::size_t n = 0; n < clutter; ++n)
      scan.push_back({{random_.uniform(0, side), random_.uniform(0, side)}, false});
    scans_.push_back(std::move(scan));
  }

  std::vector<Index> sizes() const {
    std::vector<Index> sizes = {static_cast<Index>(targets_.size())};
    for (const auto& scan : scans_) sizes.push_back(static_cast<Index>(scan.size()));
    return sizes;
  }

  void add_track(ProblemBuilder& builder, Index track) const {
    std::vector<Hypothesis> all = {{0, {track}}};
    for (const auto& scan : scans_) all = extended(all, scan, targets_[track - 1]);
    for (const Hypothesis& one : all) {
      const auto real =
          std::count_if(one.tuple.begin(), one.tuple.end(), [](Index i) { return i != 0; });
      builder.add_arc(one.tuple, real > 1 ? std::round(one.cost * 1000) / 1000 : one.cost);
    }
  }

  std::vector<Hypothesis> extended(const std::vector<Hypothesis>& from,
                                   const std::vector<Measurement>& scan,
                                   Point target) const {
    std::vector<Hypothesis> longer;
    const auto extend = [&](Index z, double cost) {
      for (const Hypothesis& one : from) {
        longer.push_back({one.cost + cost, one.tuple});
        longer.back().tuple.push_back(z);
      }
    };
    extend(0, kMissed);
    for (Index z = 1; z <= scan.size(); ++z) {
      const double dx = scan[z - 1].at.x - target.x;
      const double dy = scan[z - 1].at.y - target.y;
      const double square = dx * dx + dy * dy;
      if (square < kGate) extend(z, kDetected + square / 2);
    }
    std::sort(longer.begin(), longer.end(), [](const Hypothesis& a, const Hypothesis& b) {
      return std::pair(a.cost, a.tuple) < std::pair(b.cost, b.tuple);
    });
    if (longer.size() > options_.arcs_per_track) longer.resize(options_.arcs_per_track);
    const auto is_alone = [](const Hypothesis& one) {
      return std::count(one.tuple.begin() + 1, one.tuple.end(), 0u) + 1 ==
             static_cast<std::ptrdiff_t>(one.tuple.size());
    };
    if (std::none_of(longer.begin(), longer.end(), is_alone)) {
      const double missed = kMissed * static_cast<double>(from.front().tuple.size());
      std::vector<Index> alone(from.front().tuple.size() + 1, 0);
      alone[0] = from.front().tuple[0];
      longer.push_back({missed, alone});
    }
    return longer;
  }

  const MergedTracksOptions options_;
  core::Random random_;
  std::vector<Point> targets_;
  std::vector<std::vector<Measurement>> scans_;
};

/// Of so many tracks in three scans, some of which merge.
inline Problem merged_tracks(int tracks, std::uint64_t seed) {
  MergedTracksOptions options;
  options.tracks = tracks;
  options.seed = seed;
  return MergedTracks(options).make();
}

}  // namespace nda::support
