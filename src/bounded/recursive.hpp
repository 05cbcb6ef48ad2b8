#pragma once

#include "bounded/relaxed_dual.hpp"
#include "core/clock.hpp"
#include "nda/options.hpp"

namespace nda::bounded {

/// Recursive recovery with bounds: the recovery problem, of n - m + 1 dimensions where the point
/// keeps m of n (m >= 2), is solved by relaxation to two dimensions and recovery again, down to two
/// dimensions, where one flow is exact; at three, a choice is recovered at every nonsmooth step
/// (report, section 5).  Its components are solved one by one; those that the deadline leaves over
/// stay as they are without arcs.
///
/// @return  a choice of the component that exceeds no bound (3.9); it may pay the penalties of
///          forbidden singletons
/// Source: report, section 3.2.
Choice recover_recursively(const BoundedComponent& component,
                           const RelaxedDual& point,
                           const RelaxationOptions& options,
                           const core::Deadline& deadline);

}  // namespace nda::bounded
