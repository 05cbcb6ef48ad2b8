#pragma once

#include <vector>

#include "core/component.hpp"
#include "core/shift.hpp"
#include "nda/problem.hpp"

namespace nda::pipeline {

/// By slot: what the shift charges.
std::vector<double> charges(const core::Component& component, const core::Shift& shift);

/// By slot: whether its singleton is forbidden.
std::vector<bool> required_slots(const core::Component& component, const Problem& problem);

}  // namespace nda::pipeline
