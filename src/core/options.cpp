#include "nda/options.hpp"

#include <cmath>

namespace nda {
namespace {

void require(bool holds, const std::string& name, double value, const char* rule) {
  if (holds) return;
  std::string text = std::to_string(value);
  throw InputError("option " + name + " is " + text + ", it must be " + rule);
}

}  // namespace

void validate(const Options& options) {
  require(options.time_limit_s > 0, "time_limit_s", options.time_limit_s, "above 0");
  require(options.relative_gap >= 0, "relative_gap", options.relative_gap, "0 or more");
  require(options.num_threads >= 0, "num_threads", options.num_threads, "0 or more");
  const RelaxationOptions& relaxation = options.relaxation;
  require(relaxation.max_evaluations >= 1,
          "relaxation.max_evaluations",
          relaxation.max_evaluations,
          "1 or more");
  require(relaxation.recovery_evaluations >= 1,
          "relaxation.recovery_evaluations",
          relaxation.recovery_evaluations,
          "1 or more");
  require(relaxation.recovery_interval >= 1,
          "relaxation.recovery_interval",
          relaxation.recovery_interval,
          "1 or more");
  require(relaxation.relative_tolerance >= 0,
          "relaxation.relative_tolerance",
          relaxation.relative_tolerance,
          "0 or more");
  require(options.search.kicks_per_index >= 0,
          "search.kicks_per_index",
          options.search.kicks_per_index,
          "0 or more");
  require(options.branch.max_nodes >= 0,
          "branch.max_nodes",
          static_cast<double>(options.branch.max_nodes),
          "0 or more");
  require(options.branch.node_evaluations >= 1,
          "branch.node_evaluations",
          options.branch.node_evaluations,
          "1 or more");
}

Options preset(const std::string& name) {
  Options options;
  if (name == "default") return options;
  if (name == "realtime") {
    options.time_limit_s = 0.05;
    options.relative_gap = 1e-3;
    options.relaxation.max_evaluations = 60;
    return options;
  }
  if (name == "exact") {
    options.relaxation.max_evaluations = 500;
    options.branch.node_evaluations = 100;
    return options;
  }
  throw InputError("preset '" + name + "' is not known; there are realtime, default, exact");
}

}  // namespace nda
