#pragma once

#include <cstddef>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// Relieves every index all of whose arcs share another index that still counts.  Returns how many
/// it relieved.  Cost: O(A N), mostly O(indices N), as two arcs of an index rarely share more.
std::size_t relieve_redundant_indices(ArcPool& pool);

}  // namespace nda::reduce
