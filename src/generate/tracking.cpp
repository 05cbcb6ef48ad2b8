#include <string>

#include "generate/hypotheses.hpp"
#include "generate/parameters.hpp"
#include "generate/scenario.hpp"
#include "nda/generate.hpp"

// Puts scenario and hypotheses together.  Tuples that start in the last scans come first in
// lexicographic order (their first indices are dummies), so the starting scans are taken backwards
// and nothing needs sorting.

namespace nda {
namespace {

void validate(const TrackingOptions& options) {
  using generate::require;
  generate::require_dimensions(options.scans);
  require(options.targets >= 1, "targets", options.targets, "must be at least 1");
  require(options.side > 0 && options.side <= 1e9, "side", options.side, "must be in (0, 1e9]");
  require(options.clutter > 0 && options.clutter <= 1e8,
          "clutter",
          options.clutter,
          "must be in (0, 1e8]");
  require(options.detection_probability > 0 && options.detection_probability < 1,
          "detection_probability",
          options.detection_probability,
          "must be in (0, 1)");
  require(options.noise > 0, "noise", options.noise, "must be positive");
  require(options.max_speed > 0, "max_speed", options.max_speed, "must be positive");
  require(
      options.process_noise >= 0, "process_noise", options.process_noise, "must not be negative");
  require(options.gate_probability > 0 && options.gate_probability < 1,
          "gate_probability",
          options.gate_probability,
          "must be in (0, 1)");
  require(options.max_misses >= 0, "max_misses", options.max_misses, "must not be negative");
  require(options.group_size >= 0, "group_size", options.group_size, "must not be negative");
  require(options.group_spread >= 0, "group_spread", options.group_spread, "must not be negative");
  require(options.velocity_spread >= 0,
          "velocity_spread",
          options.velocity_spread,
          "must not be negative");
  require(options.cap >= 0, "cap", options.cap, "must not be negative");
}

std::vector<std::string> comments(const TrackingOptions& options) {
  generate::Parameters parameters(options.group_size > 0 ? "groups" : "tracking", options.seed);
  parameters.add("scans", options.scans);
  parameters.add("targets", options.targets);
  parameters.add("side", options.side);
  parameters.add("clutter", options.clutter);
  parameters.add("detection-probability", options.detection_probability);
  parameters.add("noise", options.noise);
  parameters.add("max-speed", options.max_speed);
  parameters.add("process-noise", options.process_noise);
  parameters.add("gate-probability", options.gate_probability);
  parameters.add("max-misses", options.max_misses);
  parameters.add("cap", options.cap);
  if (options.group_size > 0) {
    parameters.add("group-size", options.group_size);
    parameters.add("group-spread", options.group_spread);
    parameters.add("velocity-spread", options.velocity_spread);
  }
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
