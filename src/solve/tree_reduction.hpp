#pragma once

#include "bnb/branch_and_bound.hpp"

namespace nda::pipeline {

/// Fixing by reduced cost and splitting, as branch and bound wants them (bnb::Collaborators).
/// Cost: O(A N alpha).
bnb::Reduction reduce_node(const core::Component& component,
                           const bnb::NodeBound& bound,
                           double cutoff);

}  // namespace nda::pipeline
