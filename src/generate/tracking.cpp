#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "generate/hypotheses.hpp"
#include "generate/parameters.hpp"
#include "generate/scenario.hpp"
#include "nda/generate.hpp"

// Puts scenario and hypotheses together.  Tuples that start in the last scans come first in
// lexicographic order (their first indices are dummies), so the starting scans are taken backwards
// and nothing needs sorting.

namespace nda {
namespace {

constexpr double kMostPatterns = 1e5;

// Sequences of scans, from the first on, in which a target can be seen: each is a hypothesis.
double count_patterns(int scans, int max_misses) {
  std::vector<double> ending_at(static_cast<std::size_t>(scans), 0);
  ending_at[0] = 1;
  for (int s = 1; s < scans; ++s) {
    for (int gap = 1; gap <= std::min(s, max_misses + 1); ++gap) {
      ending_at[static_cast<std::size_t>(s)] += ending_at[static_cast<std::size_t>(s - gap)];
    }
  }
  return std::accumulate(ending_at.begin(), ending_at.end(), 0.0);
}

// Expected hypotheses of two false alarms, or fewer: a quarter of a disc is within the square.
double fewest_hypotheses(const TrackingOptions& options) {
  double share = 0;
  for (int gap = 1; gap <= std::min(options.max_misses + 1, options.scans - 1); ++gap) {
    const double reach = generate::second_radius(options, gap) / options.side;
    share += (options.scans - gap) * std::min(0.25, 0.25 * generate::kPi * reach * reach);
  }
  return share * options.clutter * options.clutter;
}

void validate(const TrackingOptions& options) {
  generate::require_ranges(options);
  generate::require_within("scans times targets and clutter",
                           options.scans * (options.targets + options.clutter),
                           0,
                           generate::kMostDetections);
  if (options.scenario_scans > 0) {
    generate::require_within(
        "scenario_scans", options.scenario_scans, options.scans, generate::kMostDetections);
  }
  generate::require_within(
      "first_scan", options.first_scan, 0, generate::scenario_scans(options) - options.scans);
  generate::require_within("scenario_scans times targets and clutter",
                           generate::scenario_scans(options) * (options.targets + options.clutter),
                           0,
                           generate::kMostDetections);
  generate::require_within("the number of patterns of misses that scans and max_misses allow",
                           count_patterns(options.scans, options.max_misses),
                           0,
                           kMostPatterns);
  generate::require_within("scans times hypotheses of two false alarms",
                           options.scans * fewest_hypotheses(options),
                           0,
                           generate::kMostEntries);
}

std::vector<std::string> comments(const TrackingOptions& options) {
  using Table = generate::OptionTable<TrackingOptions>;
  generate::Parameters parameters(options.group_size > 0 ? "groups" : "tracking", options.seed);
  parameters.add_rows(Table::kScenarioRows, options);
  if (options.group_size > 0) parameters.add_rows(Table::kGroupRows, options);
  if (options.scenario_scans > 0) parameters.add_rows(Table::kWindowRows, options);
  return {parameters.command()};
}

TrackingOptions scenario(int scans, int targets, double side, double clutter, int cap) {
  TrackingOptions options;
  options.scans = scans;
  options.targets = targets;
  options.side = side;
  options.clutter = clutter;
  options.cap = cap;
  return options;
}

TrackingOptions grouped(TrackingOptions options, int group_size) {
  options.group_size = group_size;
  return options;
}

}  // namespace

Instance generate_tracking(const TrackingOptions& options) {
  validate(options);
  const std::vector<generate::Scan> scans = generate::draw_scans(options);
  std::vector<Index> sizes;
  for (const generate::Scan& scan : scans) sizes.push_back(static_cast<Index>(scan.size()));
  ProblemBuilder builder(sizes);
  generate::Hypotheses hypotheses(options, scans);
  for (int s = options.scans - 1; s >= 0; --s) {
    for (std::uint32_t j = 0; j < sizes[static_cast<std::size_t>(s)]; ++j) {
      hypotheses.enumerate(s, j);
      for (std::size_t h = 0; h < hypotheses.size(); ++h) {
        builder.add_arc(hypotheses.tuple(h), generate::from_micro(hypotheses.cost(h)));
      }
    }
  }
  return {std::move(builder).build(), comments(options), std::nullopt};
}

TrackingOptions tracking_preset(const std::string& name) {
  if (name == "small") return scenario(4, 20, 600, 10, 0);
  if (name == "medium") return scenario(6, 100, 1000, 30, 500);
  if (name == "large") return scenario(5, 2000, 5000, 1000, 300);
  if (name == "largesparse") return scenario(5, 2000, 10000, 1000, 300);
  if (name == "huge") return scenario(5, 20000, 15811, 10000, 300);
  if (name == "hard6") return grouped(scenario(6, 30, 1500, 10, 500), 6);
  if (name == "hard7") return grouped(scenario(7, 30, 1500, 10, 500), 6);
  if (name == "hard8") return grouped(scenario(8, 30, 1500, 10, 1000), 6);
  if (name == "largegroup") return grouped(scenario(5, 2000, 20000, 400, 300), 8);
  if (name == "six-scan") return grouped(scenario(6, 20, 300, 4, 300), 10);
  throw InputError("no tracking preset is called " + name);
}

}  // namespace nda
