#pragma once

#include "core/component.hpp"

namespace nda::recovery {

/// The better of two packings wherever they can be told apart: arcs of both that share indices hang
/// together, and of every such cluster those of the cheaper packing are taken, of the first where
/// they are equal.  Cost: O(slots + arcs of both * N).
core::Packing combine(const core::Component& component,
                      const core::Packing& first,
                      const core::Packing& second);

}  // namespace nda::recovery
