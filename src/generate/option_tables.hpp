#pragma once

#include <algorithm>
#include <string>
#include <tuple>

#include "generate/portable.hpp"
#include "nda/generate.hpp"

namespace nda::generate {

/// One numeric option of a family.
template <typename Options, typename T>
struct Option {
  const char* name;  ///< of the field
  T Options::*field;
  double least;  ///< both ends are allowed
  double most;
  const char* help;
};

template <typename Options, typename T>
Option(const char*, T Options::*, double, double, const char*) -> Option<Options, T>;

/// kRows: the options of a family but its seed, in the order in which files and help name them.
template <typename Options>
struct OptionTable;

template <>
struct OptionTable<PooreSparseOptions> {
  using O = PooreSparseOptions;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 2, kMaxDimensions, "N"},
      Option{"min_size", &O::min_size, 1, kMostIndices, "least M_k"},
      Option{"max_size", &O::max_size, 1, kMostIndices, "largest M_k"},
      Option{"arcs", &O::arcs, 0, kMostEntries, "number of arcs"},
  };
};

template <>
struct OptionTable<PooreDenseOptions> {
  using O = PooreDenseOptions;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 2, kMaxDimensions, "N"},
      Option{"min_size", &O::min_size, 1, kMostIndices, "least M_k"},
      Option{"max_size", &O::max_size, 1, kMostIndices, "largest M_k"},
      Option{"share", &O::share, 0, 1, "share of the tuples that are arcs"},
  };
};

template <>
struct OptionTable<Map3Options> {
  using O = Map3Options;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 2, kMaxDimensions, "N"},
      Option{"size", &O::size, 1, kMostIndices, "M_k of every dimension"},
      Option{"min_cost", &O::min_cost, -1e9, 1e9, "least cost"},
      Option{"max_cost", &O::max_cost, -1e9, 1e9, "largest cost"},
  };
};

template <>
struct OptionTable<PlantedOptions> {
  using O = PlantedOptions;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 2, kMaxDimensions, "N"},
      Option{"size", &O::size, 1, kMostIndices, "M_k of every dimension"},
      Option{"arcs", &O::arcs, 0, kMostEntries, "arcs besides the planted ones"},
      Option{"miss_rate", &O::miss_rate, 0, 0.9, "share of dummies in an arc"},
      Option{"spread",
             &O::spread,
             0,
             kMostIndices,
             "how far apart the indices of an arc lie; 0 = anywhere"},
      Option{"max_multiplier", &O::max_multiplier, 1e-6, 1000, "size of the multipliers"},
      Option{"max_slack", &O::max_slack, 0, 1000, "largest reduced cost"},
  };
};

template <>
struct OptionTable<GadgetsOptions> {
  using O = GadgetsOptions;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 3, kMaxDimensions, "N"},
      Option{"gadgets", &O::gadgets, 1, kMostIndices, "number of components"},
      Option{"size", &O::size, 1, 8, "M_k of a gadget"},
      Option{"arcs_per_gadget", &O::arcs_per_gadget, 3, 14, "draws of arcs in a gadget"},
      Option{"max_cost", &O::max_cost, 1, 1e6, "costs are in -max-cost..-1"},
  };
};

template <>
struct OptionTable<BoundedOptions> {
  using O = BoundedOptions;
  static constexpr std::tuple kRows{
      Option{"dimensions", &O::dimensions, 2, kMaxDimensions, "N"},
      Option{"size", &O::size, 1, kMostIndices, "M_k of every dimension"},
      Option{"arcs", &O::arcs, 0, kMostEntries, "draws of arcs"},
      Option{"dummy_share", &O::dummy_share, 0, 0.9, "share of dummies in an arc"},
      Option{"bounds_share", &O::bounds_share, 0, 1, "share of indices with bounds of their own"},
      Option{"max_uses", &O::max_uses, 1, 1e6, "largest bound but for no limit"},
      Option{"max_cost", &O::max_cost, 1, 1e6, "costs are in -max-cost..max-cost"},
  };
};

template <>
struct OptionTable<MergedOptions> {
  using O = MergedOptions;
  static constexpr std::tuple kRows{
      Option{"scans", &O::scans, 1, 8, "N - 1"},
      Option{"targets", &O::targets, 1, 1e4, "number of targets"},
      Option{"side", &O::side, 1e-6, 1e9, "side of the square"},
      Option{"clutter", &O::clutter, 1e-6, 1e4, "false alarms per scan, expected"},
      Option{"detection_probability",
             &O::detection_probability,
             1e-6,
             0.999999,
             "of a target in a scan"},
      Option{"noise", &O::noise, 1e-6, 1e9, "sigma of a coordinate"},
      Option{"resolution", &O::resolution, 0, 1e9, "targets this close may show as one"},
      Option{"split_probability", &O::split_probability, 0, 1, "that a target shows as two"},
      Option{"merge_penalty", &O::merge_penalty, 0, 1000, "for the second target of a detection"},
      Option{"split_penalty", &O::split_penalty, 0, 1000, "for the second hypothesis of a target"},
      Option{"gate_probability", &O::gate_probability, 1e-6, 0.999999, "of a gate"},
  };
};

/// Lengths and densities are such that no square, no density and no logarithm leaves the normal
/// numbers.
template <>
struct OptionTable<TrackingOptions> {
  using O = TrackingOptions;
  static constexpr std::tuple kScenarioRows{
      Option{"scans", &O::scans, 2, kMaxDimensions, "N"},
      Option{"targets", &O::targets, 1, kMostDetections, "number of targets"},
      Option{"side", &O::side, 1e-6, 1e9, "side of the square"},
      Option{"clutter", &O::clutter, 1e-6, kMostDetections, "false alarms per scan, expected"},
      Option{"detection_probability",
             &O::detection_probability,
             1e-6,
             0.999999,
             "of a target in a scan"},
      Option{"noise", &O::noise, 1e-6, 1e9, "sigma of a coordinate"},
      Option{"max_speed", &O::max_speed, 0, 1e9, "per scan"},
      Option{"process_noise", &O::process_noise, 0, 1e9, "q of the filter"},
      Option{"gate_probability", &O::gate_probability, 1e-6, 0.999999, "of a gate"},
      Option{"max_misses", &O::max_misses, 0, kMaxDimensions, "in a row"},
      Option{"cap", &O::cap, 0, kMostEntries, "hypotheses per starting detection; 0 = all"},
  };
  static constexpr std::tuple kWindowRows{
      Option{"scenario_scans",
             &O::scenario_scans,
             0,
             kMostDetections,
             "length of the scenario that the window is cut out of; 0 = scans"},
      Option{"first_scan",
             &O::first_scan,
             0,
             kMostDetections,
             "of the window in the scenario, from 0"},
  };
  static constexpr std::tuple kGroupRows{
      Option{"group_size", &O::group_size, 0, kMostDetections, "targets per group; 0 = none"},
      Option{"group_spread", &O::group_spread, 0, 1e9, "sigma within a group"},
      Option{"velocity_spread", &O::velocity_spread, 0, 1e9, "sigma in a group"},
  };
  static constexpr std::tuple kRows = std::tuple_cat(kScenarioRows, kGroupRows, kWindowRows);
};

/// The option of a field on the command line: --max-size for max_size.
inline std::string flag_of(const char* name) {
  std::string flag = "--";
  flag += name;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

/// Calls visit(row) for every row.
template <typename Rows, typename Visit>
void for_each_row(const Rows& rows, Visit&& visit) {
  std::apply([&](const auto&... row) { (visit(row), ...); }, rows);
}

/// Throws InputError for the first option out of its range.
template <typename Options>
void require_ranges(const Options& options) {
  for_each_row(OptionTable<Options>::kRows, [&](const auto& row) {
    require_within(row.name, static_cast<double>(options.*row.field), row.least, row.most);
  });
}

}  // namespace nda::generate
