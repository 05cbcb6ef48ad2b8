#include "reduce/redundant_indices.hpp"

#include <algorithm>
#include <vector>

// Dominated rows.  Where every arc that uses index i uses index j too, "j at most once" says all
// that "i at most once" says.  Index i is relieved: its multiplier is 0 from then on, and its arcs
// no longer show it.  Of indices with the same arcs one stays, the last of them, since a relieved
// index makes no other redundant.
//
// Multipliers need no repair: what is proven without a row is proven.  The rule removes no arc by
// itself; but arcs that have lost indices come within others (dominated_arcs.hpp), and an arc that
// shows a single index is the only choice besides those of its index (single_choice_arcs.hpp).

namespace nda::reduce {
namespace {

using core::ArcId;

// The indices that all arcs share, into `common`.
void intersect(const ArcPool& pool,
               std::span<const ArcId> arcs,
               std::vector<std::uint32_t>& common) {
  const auto first = pool.slots(arcs.front());
  common.assign(first.begin(), first.end());
  for (const ArcId a : arcs.subspan(1)) {
    if (common.size() == 1) return;
    const auto slots = pool.slots(a);
    std::erase_if(common, [&](std::uint32_t slot) {
      return !std::binary_search(slots.begin(), slots.end(), slot);
    });
  }
}

}  // namespace

std::size_t relieve_redundant_indices(ArcPool& pool) {
  std::size_t relieved = 0;
  std::vector<std::uint32_t> common;
  for (std::uint32_t slot = 0; slot < pool.num_slots(); ++slot) {
    const auto arcs = pool.arcs_at(slot);
    if (arcs.empty()) continue;
    intersect(pool, arcs, common);
    if (common.size() == 1) continue;
    pool.relieve(slot);
    ++relieved;
  }
  return relieved;
}

}  // namespace nda::reduce
