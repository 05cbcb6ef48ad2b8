#pragma once

#include <cstddef>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// What transferring the weight of arcs did.
struct Transfers {
  std::size_t chosen = 0;   ///< arcs put off: chosen in the end where their index is free
  std::size_t dropped = 0;  ///< others that cost no less than these
};

/// Puts off every arc that shows a single index and charges that index its cost.
/// Cost: O(A), and the arcs of every index that is charged.
Transfers transfer_single_choices(ArcPool& pool);

}  // namespace nda::reduce
