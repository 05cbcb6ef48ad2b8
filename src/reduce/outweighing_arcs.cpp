#include "reduce/outweighing_arcs.hpp"

#include <algorithm>
#include <array>
#include <vector>

// Arcs that outweigh all they exclude.  Suppose a packing does without arc a.  Of the arcs that
// exclude a it uses at most one on each of a's indices.  Share the cost of such an arc b among the
// indices that it has in common with a, and let
//
//     v_i = min(0, least of c(b) / (number of indices that b and a share) over arcs b on i).
//
// What stands in the way of a then costs at least sum of v over the indices of a.  If a costs no
// more than that, taking it instead is no loss, so it is taken, and all it excludes is dropped.  On
// conflict graphs this is the rule of the heavy vertex (Lamm et al. 2019), with rows in the place
// of cliques.
//
// Such an arc is the cheapest on one of its indices: were all of them used by something cheaper,
// the shares c(b) / n alone would sum up to less than c(a).  So one candidate an index will do.
//
// Multipliers follow: u_i = v_i on the indices of a, lowered by equal parts until they sum up to
// c(a).  Then r(a) = 0, r(b) >= c(b) - sum of v over what b shares with a >= 0 as the other
// multipliers are <= 0, the arcs that are left use none of these indices, and the sum of
// multipliers gains c(a).

namespace nda::reduce {
namespace {

using core::ArcId;

std::size_t num_shared(std::span<const std::uint32_t> x, std::span<const std::uint32_t> y) {
  std::size_t shared = 0;
  for (auto i = x.begin(), j = y.begin(); i != x.end() && j != y.end();) {
    shared += *i == *j;
    if (*i < *j) {
      ++i;
    } else {
      ++j;
    }
  }
  return shared;
}

class Outweighing {
 public:
  explicit Outweighing(ArcPool& pool) : pool_(pool), asked_(pool.num_arcs(), false) {}

  Takings run() {
    for (std::uint32_t slot = 0; slot < pool_.num_slots(); ++slot) {
      const auto arcs = pool_.arcs_at(slot);
      if (arcs.empty()) continue;
      const ArcId a = *std::min_element(arcs.begin(), arcs.end(), [&](ArcId x, ArcId y) {
        return pool_.cost(x) < pool_.cost(y);
      });
      if (asked_[a]) continue;
      asked_[a] = true;
      if (outweighs(a)) take(a);
    }
    return takings_;
  }

 private:
  // Leaves v in share_.
  bool outweighs(ArcId a) {
    const auto slots = pool_.slots(a);
    share_.assign(slots.size(), 0.0);
    double sum = 0;
    for (std::size_t n = 0; n < slots.size(); ++n) {
      for (const ArcId b : pool_.arcs_at(slots[n])) {
        if (b == a || pool_.cost(b) >= share_[n]) continue;
        const auto shared = static_cast<double>(num_shared(pool_.slots(b), slots));
        share_[n] = std::min(share_[n], pool_.cost(b) / shared);
        if (sum + share_[n] < pool_.cost(a)) return false;
      }
      sum += share_[n];
    }
    rest_ = pool_.cost(a) - sum;
    return true;
  }

  void take(ArcId a) {
    const std::size_t before = pool_.num_alive();
    const auto slots = pool_.slots(a);
    for (std::size_t n = 0; n < slots.size(); ++n) {
      pool_.note_charge(slots[n], share_[n] + rest_ / static_cast<double>(slots.size()));
      for (const ArcId b : pool_.arcs_at(slots[n])) pool_.drop(b);
    }
    pool_.choose(std::array{a});
    ++takings_.taken;
    takings_.dropped += before - pool_.num_alive() - 1;
  }

  ArcPool& pool_;
  Takings takings_;
  std::vector<bool> asked_;    // [arc]: it may be the cheapest on several indices
  std::vector<double> share_;  // by position in the arc at hand
  double rest_ = 0;            // of its cost beyond the shares
};

}  // namespace

Takings take_outweighing_arcs(ArcPool& pool) {
  return Outweighing(pool).run();
}

}  // namespace nda::reduce
