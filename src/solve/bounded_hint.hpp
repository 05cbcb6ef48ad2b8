#pragma once

#include "bounded/bounded_solver.hpp"
#include "nda/warm_start.hpp"

namespace nda::pipeline {

/// What a warm start says of a part with bounds: its multipliers, and the arcs that mix no two old
/// tuples, then the others, by reduced cost.  An index that was shared belongs to no tuple. Nothing
/// where the warm start is empty.  Cost: O(A (N + log A)).
bounded::BoundedHint make_hint(const bounded::BoundedComponent& part, const WarmStart& warm);

}  // namespace nda::pipeline
