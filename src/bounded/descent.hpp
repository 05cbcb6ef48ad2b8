#pragma once

#include <span>

#include "bounded/bounded_component.hpp"
#include "core/clock.hpp"

namespace nda::bounded {

/// A choice made greedily and improved by exchanges.
///
/// Goes through `order` and takes every arc that fits and lowers the cost; then, over and over,
/// takes an arc out that costs more than it saves, or one in, for which an arc leaves every index
/// that is full, as long as the cost falls.  Arcs that are not in `order` are not chosen.
/// Cost: some passes over `order`.
Choice greedy_descent(const BoundedComponent& component,
                      std::span<const core::ArcId> order,
                      const core::Deadline& deadline);

}  // namespace nda::bounded
