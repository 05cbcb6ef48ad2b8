#pragma once

#include <cstddef>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// What cutting sides off did.
struct Cuttings {
  std::size_t sides = 0;
  std::size_t dropped = 0;  ///< their arcs, and others that pay no more beside them
};

inline constexpr std::size_t kMostSideArcs = 24;

/// Solves small parts that hang on the rest by one index, with and without that index, and charges
/// it the difference; a part of at most kMostSideArcs arcs whose linear relaxation is exact, as far
/// as coordinate ascent can tell.  Components of that size are such parts themselves.
/// Cost: O(A N) to find them; to solve one at most some ten thousand steps.
Cuttings cut_sides_off(ArcPool& pool);

}  // namespace nda::reduce
