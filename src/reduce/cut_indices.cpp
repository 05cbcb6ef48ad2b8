#include "reduce/cut_indices.hpp"

#include <algorithm>
#include <limits>

#include "reduce/small_packing.hpp"

// Cut indices.  Let the arcs of a *side* share no index with the others but i.  The best packing of
// the side costs V0 without i and V1 <= V0 with it, so to the rest the whole side is like leaving i
// alone at V1 - V0, on top of V0: i is charged V1 - V0, the side goes, and in the end its first
// packing is chosen where i stayed free, the second where it did not.
//
// Multipliers must follow: some w <= 0 on the side's other indices with sum V0 must leave no arc of
// the side a negative reduced cost when i has V1 - V0 (the rest lowers u_i further, which helps).
// Such w exist exactly where V0 and V1 are ends of the linear relaxation of the side, one line; a
// few sweeps of coordinate ascent find them, or the side stays as it is.
//
// Sides are found by depth-first search over the graph of indices and arcs (Hopcroft and Tarjan
// 1973): what is below an arc that leads from index i to nothing above i hangs on i.  It lists
// inner sides before the outer ones that contain them, so chains of sides go one after the other.

namespace nda::reduce {
namespace {

using core::ArcId;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
// Of the arcs below an index, gone or not: beyond that nobody looks whether few are left.
constexpr std::size_t kMostListedArcs = 256;

// What hangs on an index: a range of the order of visits.
struct Side {
  std::uint32_t slot;
  std::size_t begin;
  std::size_t end;
};

// Depth-first search over the graph whose vertices are indices and arcs.  No arc is dropped
// meanwhile, so lists stay as they are.
class SideFinder {
 public:
  explicit SideFinder(ArcPool& pool)
      : pool_(pool), slot_number_(pool.num_slots(), kNone), arc_number_(pool.num_arcs(), kNone) {}

  // From the busiest index first: it is hardly on a small side itself.
  void run() {
    std::uint32_t busiest = 0;
    for (std::uint32_t slot = 1; slot < pool_.num_slots(); ++slot) {
      if (pool_.arcs_at(slot).size() > pool_.arcs_at(busiest).size()) busiest = slot;
    }
    if (!pool_.arcs_at(busiest).empty()) search_from(busiest);
    for (std::uint32_t slot = 0; slot < pool_.num_slots(); ++slot) {
      if (slot_number_[slot] == kNone && !pool_.arcs_at(slot).empty()) search_from(slot);
    }
  }

  std::span<const Side> sides() const { return sides_; }
  std::span<const ArcId> order() const { return order_; }

 private:
  struct Visit {
    bool is_arc;
    std::uint32_t vertex;
    std::size_t next = 0;         // neighbour
    std::uint32_t lowest;         // number that can be reached from below
    std::size_t order_begin = 0;  // of an arc: where what is below it begins
  };

  void search_from(std::uint32_t root) {
    open_slot(root);
    while (!path_.empty()) {
      Visit& visit = path_.back();
      const std::span<const std::uint32_t> neighbours =
          visit.is_arc ? pool_.slots(visit.vertex) : pool_.arcs_at(visit.vertex);
      if (visit.next == neighbours.size()) {
        close();
        continue;
      }
      const std::uint32_t other = neighbours[visit.next++];
      const std::uint32_t number = visit.is_arc ? slot_number_[other] : arc_number_[other];
      if (number != kNone) {
        visit.lowest = std::min(visit.lowest, number);
      } else if (visit.is_arc) {
        open_slot(other);
      } else {
        open_arc(other);
      }
    }
  }

  void open_slot(std::uint32_t slot) {
    slot_number_[slot] = next_number_++;
    path_.push_back({false, slot, 0, slot_number_[slot]});
  }

  void open_arc(ArcId a) {
    arc_number_[a] = next_number_++;
    path_.push_back({true, a, 0, arc_number_[a], order_.size()});
    order_.push_back(a);
  }

  void close() {
    const Visit done = path_.back();
    path_.pop_back();
    if (path_.empty()) return;
    Visit& above = path_.back();
    above.lowest = std::min(above.lowest, done.lowest);
    if (!done.is_arc || done.lowest < slot_number_[above.vertex]) return;
    if (order_.size() - done.order_begin > kMostListedArcs) return;
    sides_.push_back({above.vertex, done.order_begin, order_.size()});
  }

  ArcPool& pool_;
  std::vector<std::uint32_t> slot_number_;
  std::vector<std::uint32_t> arc_number_;
  std::uint32_t next_number_ = 0;
  std::vector<Visit> path_;
  std::vector<ArcId> order_;
  std::vector<Side> sides_;
};

// Returns how many arcs that dropped; 0 = it stays.
std::size_t cut_off(ArcPool& pool, std::uint32_t slot, std::span<const ArcId> arcs) {
  SmallPacking side(pool, arcs);
  if (!side.solve(slot)) return 0;
  for (std::size_t row = 0; row < side.slots().size(); ++row)
    pool.note_charge(side.slots()[row], side.multipliers()[row]);
  const std::size_t before = pool.num_alive();
  for (const ArcId a : arcs) pool.drop(a);
  pool.charge(slot, side.cost_with() - side.cost_without());
  pool.choose(side.with(), side.without());
  return before - pool.num_alive();
}

}  // namespace

Cuttings cut_sides_off(ArcPool& pool) {
  SideFinder finder(pool);
  finder.run();
  Cuttings cuttings;
  std::vector<ArcId> arcs;
  for (const Side& side : finder.sides()) {
    arcs.clear();
    for (const ArcId a : finder.order().subspan(side.begin, side.end - side.begin)) {
      if (pool.alive(a)) arcs.push_back(a);
    }
    if (arcs.empty() || arcs.size() > kMostSideArcs) continue;
    const std::size_t dropped = cut_off(pool, side.slot, arcs);
    cuttings.sides += dropped > 0;
    cuttings.dropped += dropped;
  }
  return cuttings;
}

}  // namespace nda::reduce
