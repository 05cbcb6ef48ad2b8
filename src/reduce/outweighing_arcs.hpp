#pragma once

#include <cstddef>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// What taking arcs did.
struct Takings {
  std::size_t taken = 0;
  std::size_t dropped = 0;  ///< arcs that share an index with these
};

/// Takes every arc that outweighs all it excludes, as far as its indices can tell.
/// Cost: O(A N) to find the cheapest arc of every index; then mostly little, as the sum over an
/// arc's indices is broken off where it falls short.
Takings take_outweighing_arcs(ArcPool& pool);

}  // namespace nda::reduce
