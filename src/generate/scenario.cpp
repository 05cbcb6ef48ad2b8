#include "generate/scenario.hpp"

#include <algorithm>
#include <utility>

#include "generate/portable.hpp"

// Scans are numbered 0..N-1 and a scan is the unit of time.  A target that leaves the square is
// still seen; clutter falls inside only.  Sorting a scan by x hides what is a target and what is
// not, and keeps neighbours together as a sensor that sweeps would.

namespace nda::generate {
namespace {

struct Target {
  Point position;  // at scan 0
  Point velocity;  // per scan
};

Point draw_velocity(Draw& draw, const TrackingOptions& options) {
  Point velocity;
  draw.disc(options.max_speed, velocity.x, velocity.y);
  return velocity;
}

Point draw_position(Draw& draw, const TrackingOptions& options) {
  const double x = options.side * draw.uniform();
  return {x, options.side * draw.uniform()};
}

Point deviate(Draw& draw, Point from, double deviation) {
  const double x = from.x + deviation * draw.gaussian();
  return {x, from.y + deviation * draw.gaussian()};
}

std::vector<Target> draw_targets(Draw& draw, const TrackingOptions& options) {
  std::vector<Target> targets;
  const double middle = 0.5 * (scenario_scans(options) - 1);
  Point meeting, common;
  for (int t = 0; t < options.targets; ++t) {
    if (options.group_size == 0) {
      const Point position = draw_position(draw, options);
      targets.push_back({position, draw_velocity(draw, options)});
      continue;
    }
    if (t % options.group_size == 0) {
      meeting = draw_position(draw, options);
      common = draw_velocity(draw, options);
    }
    const Point at_middle = deviate(draw, meeting, options.group_spread);
    const Point velocity = deviate(draw, common, options.velocity_spread);
    targets.push_back(
        {{at_middle.x - middle * velocity.x, at_middle.y - middle * velocity.y}, velocity});
  }
  return targets;
}

Scan draw_scan(Draw& draw,
               const TrackingOptions& options,
               const std::vector<Target>& targets,
               int time) {
  Scan scan;
  for (const Target& target : targets) {
    if (draw.uniform() >= options.detection_probability) continue;
    const Point truth = {target.position.x + time * target.velocity.x,
                         target.position.y + time * target.velocity.y};
    scan.push_back(deviate(draw, truth, options.noise));
  }
  const int clutter = draw.poisson(options.clutter);
  for (int c = 0; c < clutter; ++c) scan.push_back(draw_position(draw, options));
  std::sort(scan.begin(), scan.end(), [](const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  return scan;
}

}  // namespace

int scenario_scans(const TrackingOptions& options) {
  return options.scenario_scans == 0 ? options.scans : options.scenario_scans;
}

std::vector<Scan> draw_scans(const TrackingOptions& options) {
  Draw draw(options.seed);
  const std::vector<Target> targets = draw_targets(draw, options);
  std::vector<Scan> scans;
  for (int s = 0; s < options.first_scan + options.scans; ++s) {
    Scan scan = draw_scan(draw, options, targets, s);
    if (s >= options.first_scan) scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace nda::generate
