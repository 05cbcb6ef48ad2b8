#pragma once

#include <cstddef>
#include <vector>

#include "core/component.hpp"
#include "nda/options.hpp"
#include "relax/lagrangian.hpp"

namespace nda::relax {

/// The dimensions of a component in the order of a rule, equals as given.  The relaxation keeps the
/// first of them; the order of those, and of the others, matters to recovery alone.
///
/// @param loop  how the dual is maximised, for SetOrder::kProbe: ten evaluations of each choice of
///              kept sets, or, where these are more than twenty, of each set kept with the first
///              others.
/// Cost: O(A N), but for probes.
std::vector<std::size_t> set_order(const core::Component& component,
                                   SetOrder rule,
                                   const LagrangianOptions& loop);

}  // namespace nda::relax
