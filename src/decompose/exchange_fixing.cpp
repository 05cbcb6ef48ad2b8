#include "decompose/exchange_fixing.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/find_set.hpp"

// Why it is right: take a packing P of least cost, E its excluded arcs, T the places that these
// touch.  Every other arc of P lies within one place.  Put the best packing's arcs of T in the
// place of what P has there.  Outside of T nothing changes; within, P lost at least sum r over E,
// which is no less than what the best packing loses in T, as every place of T is touched by some
// arc of E and every arc of E costs what all of its places lose.  So what results costs no more
// than P.
//
// Joining places only ever adds losses, so arcs that are open stay open, and it is repeated until
// nothing changes.

namespace nda::decompose {
namespace {

using core::ArcId;
using core::Component;

// Disjoint sets of slots, each with its loss.
class Places {
 public:
  Places(const Component& component,
         std::span<const double> u,
         std::span<const double> reduced,
         const core::Packing& best)
      : parent_(component.num_slots()),
        loss_(component.num_slots()),
        noted_(component.num_slots()),
        asked_(component.num_slots(), 0),
        is_open_(component.num_slots(), 0) {
    for (std::size_t k = 0; k < component.sizes.size(); ++k)
      columns_.push_back({component.indices[k].data(), component.offset[k]});
    std::iota(parent_.begin(), parent_.end(), 0u);
    for (std::size_t slot = 0; slot < u.size(); ++slot) loss_[slot] = -u[slot];
    for (const ArcId a : best.arcs) {
      const std::uint32_t first = first_slot(a);
      core::for_each_slot(component, a, [&](std::uint32_t slot) { parent_[slot] = first; });
      loss_[first] = std::max(0.0, reduced[a]);
    }
  }

  // What the places that an arc touches lose.
  double loss(ArcId a) {
    touched_.clear();
    ++question_;
    double sum = 0;
    for (const Column& column : columns_) {
      if (column.index[a] == 0) continue;
      const std::uint32_t place = find(column.offset + column.index[a]);
      if (std::exchange(asked_[place], question_) == question_) continue;
      touched_.push_back(place);
      sum += loss_[place];
    }
    return sum;
  }

  // Joins the places that the last arc asked about touches to one that is open; whether they were
  // several.
  bool open_touched() {
    const std::uint32_t whole = touched_.front();
    is_open_[whole] = 1;
    for (const std::uint32_t place : touched_) {
      if (place == whole) continue;
      parent_[place] = whole;
      loss_[whole] += loss_[place];
    }
    return touched_.size() > 1;
  }

  bool is_open(ArcId a) { return is_open_[find(first_slot(a))]; }

  // For most_loss().
  void note_losses() {
    for (std::uint32_t slot = 0; slot < noted_.size(); ++slot) noted_[slot] = loss_[find(slot)];
  }
  // What they lost when that was noted, places counted once for every index: quicker to say.
  double most_loss(ArcId a) const {
    double sum = 0;
    for (const Column& column : columns_) sum += noted_[column.offset + column.index[a]];
    return sum;
  }
  double total_loss() const {
    double sum = 0;
    for (std::uint32_t slot = 0; slot < loss_.size(); ++slot)
      sum += parent_[slot] == slot ? loss_[slot] : 0.0;
    return sum;
  }

 private:
  struct Column {
    const Index* index;
    std::uint32_t offset;
  };

  std::uint32_t find(std::uint32_t slot) { return core::find_set(parent_, slot); }
  std::uint32_t first_slot(ArcId a) const {
    auto column = columns_.begin();
    while (column->index[a] == 0) ++column;
    return column->offset + column->index[a];
  }

  std::vector<Column> columns_;
  std::vector<std::uint32_t> parent_;
  std::vector<double> loss_;          // of the first slots of places
  std::vector<double> noted_;         // by slot
  std::vector<std::uint64_t> asked_;  // of these: by the last question
  std::vector<char> is_open_;         // of these
  std::uint64_t question_ = 0;
  std::vector<std::uint32_t> touched_;  // places
};

// Arcs outside the best packing that cost less than what all places lose.
std::vector<ArcId> candidates(std::span<const double> reduced,
                              std::span<const char> is_best,
                              double room) {
  std::vector<ArcId> found(reduced.size());
  std::size_t size = 0;
  for (ArcId a = 0; a < reduced.size(); ++a) {  // without a jump
    found[size] = a;
    size += reduced[a] < room && is_best[a] == 0;
  }
  found.resize(size);
  return found;
}

}  // namespace

ExchangeFixing fix_by_exchange(const Component& component,
                               std::span<const double> u,
                               std::span<const double> reduced,
                               const core::Packing& best,
                               double tolerance) {
  Places places(component, u, reduced, best);
  std::vector<char> is_best(component.num_arcs(), 0);
  for (const ArcId a : best.arcs) is_best[a] = 1;
  std::vector<char> is_open(component.num_arcs(), 0);
  const double room = places.total_loss() - tolerance;
  std::vector<ArcId> rest = candidates(reduced, is_best, room);
  for (bool joined = true; joined;) {
    joined = false;
    places.note_losses();
    std::erase_if(rest, [&](ArcId a) {
      const double least = reduced[a] + tolerance;
      if (least >= places.most_loss(a) || least >= places.loss(a)) return false;
      joined = places.open_touched() || joined;
      is_open[a] = 1;
      return true;
    });
  }
  ExchangeFixing fixing;
  for (ArcId a = 0; a < is_open.size(); ++a) {
    if (is_open[a] || (is_best[a] && places.is_open(a))) fixing.open.push_back(a);
  }
  for (const ArcId a : best.arcs) {
    if (!places.is_open(a)) fixing.settled.push_back(a);
  }
  return fixing;
}

}  // namespace nda::decompose
