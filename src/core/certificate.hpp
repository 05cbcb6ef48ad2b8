#pragma once

#include <string>
#include <vector>

#include "nda/problem.hpp"

namespace nda::core {

/// What is wrong with the shape or the values of multipliers; empty when nothing is.
std::string multipliers_fault(const Problem& problem,
                              const std::vector<std::vector<double>>& multipliers);

}  // namespace nda::core
