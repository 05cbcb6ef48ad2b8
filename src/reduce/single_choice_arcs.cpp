#include "reduce/single_choice_arcs.hpp"

#include <array>

// Single choices, with transfer of their weight.  Arc a is *single* when all arcs that exclude it
// share one of its indices, i; its other indices are redundant then (redundant_indices.hpp), and i
// is all it shows.  Either an arc on i is chosen, or a can be: nothing else is in its way.  So a is
// charged to i like the cost of leaving i alone: every other arc on i costs c(b) - c(a) from now
// on, those that do not pay any more are dropped, and in the end a is chosen where i stayed free.
// It is the cost shift once more, with a in the place of the singleton; on conflict graphs it is
// the transfer of weight of a simplicial vertex (Lamm et al. 2019).  A clique of neighbours without
// an index in common is no row of the linear relaxation, so it is no case of this rule: multipliers
// could not follow.
//
// Here they can.  With multipliers u' <= 0 of the rest, u_i = u'_i + c(a) is right for all:
//
//     r(b) = c(b) - c(a) - sum of u' over b = r'(b) >= 0,    r(a) = -u'_i >= 0,
//
// a dropped arc b has c(b) >= c(a) and hence r(b) >= 0, and the sum of multipliers gains c(a),
// which is just what the cost gains.

namespace nda::reduce {

using core::ArcId;

Transfers transfer_single_choices(ArcPool& pool) {
  Transfers transfers;
  for (ArcId a = 0; a < pool.num_arcs(); ++a) {
    if (!pool.alive(a) || pool.slots(a).size() != 1) continue;
    const std::uint32_t slot = pool.slots(a).front();
    const double cost = pool.cost(a);
    pool.drop(a);
    pool.choose(std::array{a});
    transfers.dropped += pool.charge(slot, cost);
    ++transfers.chosen;
  }
  return transfers;
}

}  // namespace nda::reduce
