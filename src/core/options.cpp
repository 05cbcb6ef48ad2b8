#include "nda/options.hpp"

#include "core/option_table.hpp"

namespace nda {

void validate(const Options& options) {
  for (const core::OptionRow& row : core::option_table()) {
    if (row.holds(options)) continue;
    throw InputError("option " + row.name + " is " + row.text(options) + ", it must be " +
                     row.rule);
  }
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
