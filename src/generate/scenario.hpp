#pragma once

#include <vector>

#include "nda/generate.hpp"

namespace nda::generate {

struct Point {
  double x = 0;
  double y = 0;
};

/// Detections of one scan, ascending in x; detection j has index j + 1.
using Scan = std::vector<Point>;

/// Scans of the scenario that the window is cut out of.
int scenario_scans(const TrackingOptions& options);

/// Targets of constant velocity and what is seen of them in the window: every target with the
/// detection probability, with Gaussian noise, among Poisson clutter uniform in the square.  Lone
/// targets start uniformly in the square with a velocity uniform in a disc.  The members of a group
/// meet at mid-scenario: a common point and velocity, drawn likewise, plus Gaussian deviations of
/// each.
std::vector<Scan> draw_scans(const TrackingOptions& options);

}  // namespace nda::generate
