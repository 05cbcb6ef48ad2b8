#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nda/problem.hpp"

// The benchmark families (docs/families.md defines each).  The same options give the same problem
// on every platform: integer random numbers, no library logarithm, costs rounded to six decimals
// (so that 10^6 times a cost is an integer).
//
// Every function throws InputError naming an option out of range, before any work: no dimension has
// more than 10^8 / N indices, no problem more than 10^9 / N arcs (N its dimensions; what becomes of
// the tracking options is known only on the way).

namespace nda {

/// A generated problem.
struct Instance {
  Problem problem;
  std::vector<std::string>
      comments;  ///< family and parameters, one line each, and the optimum if known
  std::optional<double> optimum;  ///< known by construction
};

/// `poore-5.1`: arcs at random among the tuples of real indices, without repetition; costs uniform
/// in
/// [-100, -1], singletons free.  Source: AFOSR report 1995, section 5, figures 5.1 and 5.2.  O(arcs
/// log arcs).
struct PooreSparseOptions {
  int dimensions = 4;
  Index min_size = 25;  ///< M_k is uniform in min_size..max_size, at least 1
  Index max_size = 25;
  std::size_t arcs = 5000;
  std::uint64_t seed = 1;
};
Instance generate_poore_sparse(const PooreSparseOptions& options = {});

/// `poore-5.3`: a share of all tuples with two or more real indices (dummies included), exactly
/// counted; costs and singletons uniform in [1, 100].  Source: AFOSR report 1995, section 5,
/// figure 5.3. O(product of (M_k + 1)), which must be below 2^30.
struct PooreDenseOptions {
  int dimensions = 4;
  Index min_size = 7;  ///< M_k is uniform in min_size..max_size, at least 1
  Index max_size = 7;
  double share = 0.25;  ///< in [0, 1]
  std::uint64_t seed = 1;
};
Instance generate_poore_dense(const PooreDenseOptions& options = {});

/// `map3`: the dense axial assignment problem: all size^dimensions tuples of real indices, integer
/// costs uniform in min_cost..max_cost, singletons forbidden.  size^dimensions must be below 2^30.
struct Map3Options {
  int dimensions = 3;
  Index size = 10;   ///< at least 1
  int min_cost = 0;  ///< costs in [-10^9, 10^9]
  int max_cost = 100;
  std::uint64_t seed = 1;
};
Instance generate_map3(const Map3Options& options = {});

/// Singletons of the planted family.
enum class PlantedSingletons {
  kFree,       ///< all 0; multipliers are <= 0
  kPriced,     ///< multiplier plus slack; multipliers of both signs
  kForbidden,  ///< +inf; needs miss_rate 0
};

/// `planted`: multipliers u are drawn first, then disjoint arcs of reduced cost 0 that, with
/// singletons of reduced cost 0, cover everything; all other arcs and singletons get a reduced cost
/// >= 0. So optimum = LP value = sum of u, at any size.  O(arcs log arcs).
struct PlantedOptions {
  int dimensions = 5;
  Index size = 1000;           ///< M_k of every dimension, at least 1
  std::size_t arcs = 20000;    ///< draws besides the planted ones; repeated tuples make it fewer
  double miss_rate = 0.1;      ///< share of dummies in an arc, in [0, 0.9]
  Index spread = 10;           ///< indices of an arc lie within so many of each other; 0 = anywhere
  double max_multiplier = 10;  ///< size of the multipliers, in [1e-6, 1000]
  double max_slack = 5;        ///< reduced costs are uniform in [0, max_slack], in [0, 1000]
  PlantedSingletons singletons = PlantedSingletons::kFree;
  std::uint64_t seed = 1;
};
Instance generate_planted(const PlantedOptions& options = {});

/// `gadgets`: a disjoint union of small random problems with an integrality gap, indices relabelled
/// at random. Each gadget is solved by enumeration; its gap is certified by a half-integral
/// solution that costs less than the optimum (so the LP value does too).  Integer costs, free
/// singletons; the optimum is the sum.  Throws InputError where gaps are too rare to be found (many
/// dimensions of size 1).
struct GadgetsOptions {
  int dimensions = 4;        ///< at least 3
  int gadgets = 100;         ///< at least 1
  Index size = 2;            ///< M_k of each gadget, 1..8
  int arcs_per_gadget = 10;  ///< 3..14
  int max_cost = 100;        ///< costs are uniform in -max_cost..-1, 1..10^6
  std::uint64_t seed = 1;
};
Instance generate_gadgets(const GadgetsOptions& options = {});

/// `bounded`: random arcs under random bounds on uses; integer costs in -max_cost..max_cost,
/// singletons in 0..max_cost, so that there is always a solution.  O(arcs log arcs).
struct BoundedOptions {
  int dimensions = 3;
  Index size = 8;             ///< M_k of every dimension, at least 1
  std::size_t arcs = 60;      ///< draws; repeated tuples make it fewer
  double dummy_share = 0.25;  ///< probability that an index of an arc is the dummy, in [0, 0.9]
  double bounds_share = 0.5;  ///< probability that an index has bounds of its own, in [0, 1]
  int max_uses = 3;           ///< lo is in 0..max_uses, hi in max(lo, 1)..max_uses or unlimited
  int max_cost = 100;         ///< 1..10^6
  std::uint64_t seed = 1;
};
Instance generate_bounded(const BoundedOptions& options = {});

/// `merged`: targets at predicted places and scans in which two that are close show as one
/// detection and single ones sometimes as two (docs/families.md gives the formulas).  Dimension 1
/// is the targets, each other one a scan; all indices have bounds 1..2, and a second use costs.
/// Throws InputError too where there are more than 10^7 hypotheses.
struct MergedOptions {
  int scans = 2;                       ///< N - 1
  int targets = 12;                    ///< >= 1
  double side = 150;                   ///< of the square; >= 1e-6
  double clutter = 3;                  ///< expected false alarms per scan; >= 1e-6
  double detection_probability = 0.9;  ///< in [1e-6, 0.999999]
  double noise = 5;                    ///< sigma of a coordinate about the prediction; >= 1e-6
  double resolution = 20;              ///< two targets closer than this may show as one; >= 0
  double split_probability = 0.15;     ///< that one target shows as two, in [0, 1]
  double merge_penalty = 2;            ///< for the second target of a detection; in [0, 1000]
  double split_penalty = 3;            ///< for the second hypothesis of a target; in [0, 1000]
  double gate_probability = 0.99;      ///< in [1e-6, 0.999999]
  std::uint64_t seed = 1;
};
Instance generate_merged(const MergedOptions& options = {});

/// `tracking`, `groups` and `six-scan`: targets of constant velocity in a square, seen for `scans`
/// scans with noise, misses and Poisson clutter; the arcs are the gated track hypotheses with their
/// negative log likelihood ratio against false alarms (docs/families.md gives the formulas).  Time
/// unit: one scan. Singletons are free.  Detections of a scan are numbered by x.
///
/// Windows of one scenario, which differ in first_scan alone, see the same detections by the same
/// indices where they overlap; in each, hypotheses are made and scored as if it were all there is.
///
/// Lengths and speeds are at most 10^9, scans * (targets + clutter) at most 10^7, that of the
/// scenario too, and max_misses
/// must allow at most 10^5 patterns of misses in so many scans.  Throws InputError too where more
/// than 2 * 10^6 hypotheses start with one detection.
struct TrackingOptions {
  int scans = 4;           ///< N
  int scenario_scans = 0;  ///< the window is cut out of a scenario of so many scans; 0 = `scans`
  int first_scan = 0;      ///< of the window; it and `scans` must lie within the scenario
  int targets = 20;        ///< all there in every scan; >= 1
  double side = 600;       ///< L, side of the square; >= 1e-6
  double clutter = 10;     ///< expected false alarms per scan; >= 1e-6
  double detection_probability = 0.9;  ///< in [1e-6, 0.999999]
  double noise = 10;                   ///< sigma of a measured coordinate; >= 1e-6
  double max_speed = 40;               ///< velocities are uniform in a disc of this radius; >= 0
  double process_noise = 1;            ///< spectral density q of the filter; in [0, 10^9]
  double gate_probability = 0.999;     ///< in [1e-6, 0.999999]
  int max_misses = 2;                  ///< in a row; 0..64
  int group_size = 0;                  ///< targets per group; 0 = no groups
  double group_spread =
      20;  ///< standard deviation of a member's position at the middle of the scenario
  double velocity_spread = 15;  ///< standard deviation of a member's velocity
  int cap = 0;                  ///< best hypotheses kept per starting detection; 0 = all
  std::uint64_t seed = 1;
};
Instance generate_tracking(const TrackingOptions& options = {});

/// Named options: "small", "medium", "large", "largesparse", "huge" (family `tracking`); "hard6",
/// "hard7", "hard8", "largegroup" (`groups`); "six-scan".  Throws InputError for another name.
TrackingOptions tracking_preset(const std::string& name);

}  // namespace nda
