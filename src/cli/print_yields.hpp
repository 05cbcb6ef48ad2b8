#pragma once

#include "nda/solution.hpp"

namespace nda::cli {

/// Prints what every reduction and every kind of fixing did (Stats); no line for those that did
/// nothing, but for how many components were settled and how many arcs fixing left.
void print_yields(const Solution& solution);

}  // namespace nda::cli
