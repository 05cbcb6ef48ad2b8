#include "reduce/dominated_arcs.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

// Dominated arcs.  If arcs b1, b2, .. share no index, use only indices of a, and cost together no
// more than a, then a packing that uses a becomes one that costs no more when they take its place.
// Each replacement leaves fewer indices used or, the same indices being used, more arcs; so it
// comes to an end, whatever arcs are dropped at once.  Arcs with the same indices are the case of
// one b; the smaller number wins a tie.
//
// Multipliers need no repair.  They are <= 0, so with one b the reduced cost of a is at least
//
//     c(a) - sum of u over a  >=  c(b) - sum of u over b  =  r(b)  >=  0,
//
// and with several it is at least the sum of theirs.  With the multipliers of cuts the same holds,
// as the coefficient of a is at least the sum of those of the b's (floor is superadditive).
//
// Looking for the subsets of an arc's indices among the arcs takes a hash table.  The key of a set
// is the sum of random numbers of its indices, so the key of each subset is one addition away from
// another's; a bit field in the first cache answers nearly all questions.
//
// This is the reduction of dominated columns of set packing (Garfinkel and Nemhauser 1969; on
// tracks: a hypothesis that two shorter ones explain better).

namespace nda::reduce {
namespace {

using core::ArcId;

constexpr ArcId kNone = ~ArcId{0};

// A number that looks random (splitmix64).
std::uint64_t key_of(std::uint64_t slot) {
  std::uint64_t z = (slot + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

// Arcs by the set of their indices.
class SetTable {
 public:
  explicit SetTable(std::size_t num_arcs)
      : mask_(std::bit_ceil(2 * num_arcs) - 1),
        arcs_(mask_ + 1, kNone),
        bits_((8 * (mask_ + 1)) / 64 + 1, 0) {}

  // The arc of this key for which is_same(arc), or null.
  template <typename IsSame>
  ArcId* find(std::uint64_t key, IsSame&& is_same) {
    const std::uint64_t bit = bit_of(key);
    if ((bits_[bit / 64] >> (bit % 64) & 1) == 0) return nullptr;
    std::size_t n = key & mask_;
    while (arcs_[n] != kNone && !is_same(arcs_[n])) n = (n + 1) & mask_;
    return arcs_[n] == kNone ? nullptr : &arcs_[n];
  }

  void insert(std::uint64_t key, ArcId a) {
    const std::uint64_t bit = bit_of(key);
    bits_[bit / 64] |= std::uint64_t{1} << (bit % 64);
    std::size_t n = key & mask_;
    while (arcs_[n] != kNone) n = (n + 1) & mask_;
    arcs_[n] = a;
  }

 private:
  std::uint64_t bit_of(std::uint64_t key) const { return (key >> 32) & (8 * mask_ + 7); }

  std::size_t mask_;
  std::vector<ArcId> arcs_;
  std::vector<std::uint64_t> bits_;
};

// An arc within the indices of another, as bits of these.
struct Part {
  unsigned indices;
  double cost;
};

class Dominance {
 public:
  explicit Dominance(ArcPool& pool)
      : pool_(pool), table_(std::max<std::size_t>(1, pool.num_alive())), keys_(pool.num_slots()) {
    for (std::size_t slot = 0; slot < keys_.size(); ++slot) keys_[slot] = key_of(slot);
  }

  std::size_t run() {
    const std::size_t before = pool_.num_alive();
    for (ArcId a = 0; a < pool_.num_arcs(); ++a) {
      if (pool_.alive(a)) enter(a);
    }
    for (ArcId a = 0; a < pool_.num_arcs() && std::popcount(sizes_) > 1; ++a) {
      if (pool_.alive(a) && is_dominated(a)) pool_.drop(a);
    }
    return before - pool_.num_alive();
  }

 private:
  // Of arcs with the same indices the cheapest stays.
  void enter(ArcId a) {
    const auto slots = pool_.slots(a);
    std::uint64_t key = 0;
    for (const std::uint32_t slot : slots) key += keys_[slot];
    sizes_ |= std::uint64_t{1} << std::min<std::size_t>(63, slots.size());
    ArcId* const twin =
        table_.find(key, [&](ArcId b) { return std::ranges::equal(pool_.slots(b), slots); });
    if (twin == nullptr) return table_.insert(key, a);
    const bool is_cheaper = pool_.cost(a) < pool_.cost(*twin);
    pool_.drop(is_cheaper ? *twin : a);
    if (is_cheaper) *twin = a;
  }

  // Arcs that were dropped before still dominate: what took their place does.
  bool is_dominated(ArcId a) {
    const auto slots = pool_.slots(a);
    if (slots.size() < 2 || slots.size() > kMostDominatedIndices) return false;
    const unsigned all = (1u << slots.size()) - 1;
    parts_.clear();
    subset_key_[0] = 0;
    for (unsigned set = 1; set < all; ++set) {
      const auto last = static_cast<std::size_t>(std::bit_width(set) - 1);
      subset_key_[set] = subset_key_[set ^ (1u << last)] + keys_[slots[last]];
      if ((sizes_ >> std::popcount(set) & 1) == 0) continue;
      const ArcId* const b =
          table_.find(subset_key_[set], [&](ArcId arc) { return is_subset(arc, slots, set); });
      if (b == nullptr) continue;
      if (pool_.cost(*b) <= pool_.cost(a)) return true;
      parts_.push_back({set, pool_.cost(*b)});
    }
    if (parts_.size() < 2) return false;
    std::sort(
        parts_.begin(), parts_.end(), [](const Part& x, const Part& y) { return x.cost < y.cost; });
    return can_pay(pool_.cost(a), all, 0);
  }

  bool is_subset(ArcId arc, std::span<const std::uint32_t> slots, unsigned set) const {
    const auto own = pool_.slots(arc);
    if (own.size() != static_cast<std::size_t>(std::popcount(set))) return false;
    for (const std::uint32_t slot : own) {
      if (slots[static_cast<std::size_t>(std::countr_zero(set))] != slot) return false;
      set &= set - 1;
    }
    return true;
  }

  // Whether disjoint parts from number `first` on, within these indices, cost at most `cost`.
  bool can_pay(double cost, unsigned indices, std::size_t first) const {
    for (std::size_t p = first; p < parts_.size(); ++p) {
      // Whatever comes now costs no less than this one, and there are at most so many.
      if (parts_[p].cost * std::popcount(indices) > cost) return false;
      if ((parts_[p].indices & ~indices) != 0) continue;
      const double rest = cost - parts_[p].cost;
      if (rest >= 0 || can_pay(rest, indices & ~parts_[p].indices, p + 1)) return true;
    }
    return false;
  }

  ArcPool& pool_;
  SetTable table_;
  std::vector<std::uint64_t> keys_;  // [slot]
  std::uint64_t sizes_ = 0;          // bit n: some arc has n indices
  std::array<std::uint64_t, 1u << kMostDominatedIndices> subset_key_;
  std::vector<Part> parts_;
};

}  // namespace

std::size_t drop_dominated_arcs(ArcPool& pool) {
  return Dominance(pool).run();
}

}  // namespace nda::reduce
