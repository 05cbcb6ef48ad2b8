#pragma once

#include <string>
#include <vector>

#include "mip/comparison.hpp"
#include "mip/programs.hpp"

namespace nda::mip {

/// The methods that were asked for and can be run, and those that cannot.
struct MethodChoice {
  std::vector<Contender> methods;    ///< in the fixed order of method_names()
  std::vector<std::string> missing;  ///< one sentence per method that is not installed
};

/// Every name that choose_methods() knows, in the order of the table.
std::vector<std::string> method_names();

/// Looks for the methods of these names; "nda", "baseline" and "external" stand for all of a kind,
/// "paper" for the presets that follow papers, no name at all for everything but those.  A name
/// given twice counts once.  Throws InputError for an unknown one.  SciPy is looked for only when
/// it is asked for: that starts Python.
///
/// All run with relative gap 0 and one thread.  Every solution is verified by check() and its cost
/// recomputed outside the measured time; baselines have no time limit.
MethodChoice choose_methods(const std::vector<std::string>& names,
                            const Surroundings& surroundings);

}  // namespace nda::mip
