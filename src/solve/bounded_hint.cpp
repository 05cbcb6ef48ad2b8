#include "solve/bounded_hint.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "bounded/bound.hpp"
#include "bounded/split.hpp"

namespace nda::pipeline {
namespace {

using bounded::BoundedComponent;
using core::ArcId;

constexpr std::uint32_t kNone = 0;
constexpr std::uint32_t kShared = ~std::uint32_t{0};
// Arcs that are tried, per index.
constexpr std::size_t kArcsPerIndex = 12;

std::vector<double> old_multipliers(const BoundedComponent& part, const WarmStart& warm) {
  const double largest = (part.graph.num_dimensions() + 1) * bounded::largest_cost(part);
  std::vector<double> u(part.rows.size(), 0.0);
  core::for_each_index(part.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
    if (k >= warm.multipliers.size() || i > warm.multipliers[k].size()) return;
    const double old = warm.multipliers[k][i - 1];
    if (std::isfinite(old)) u[slot] = std::clamp(old, -largest, largest);
  });
  bounded::clamp(part, u);
  return u;
}

// What the old tuples say of the indices of a part.
class OldTuples {
 public:
  OldTuples(const BoundedComponent& part, const WarmStart& warm)
      : part_(part), owner_(part.rows.size(), kNone) {
    std::map<std::pair<std::size_t, Index>, std::uint32_t> slot_of;
    core::for_each_index(part.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
      slot_of[{k, i}] = slot;
    });
    for (std::uint32_t t = 0; t < warm.arcs.size(); ++t) {
      std::vector<std::uint32_t> slots;
      for (std::size_t k = 0; k < warm.arcs[t].size(); ++k) {
        const auto found = slot_of.find({k, warm.arcs[t][k]});
        if (found != slot_of.end()) slots.push_back(found->second);
      }
      for (const std::uint32_t slot : slots) owner_[slot] = owner_[slot] == kNone ? t + 1 : kShared;
      if (!slots.empty()) tuples_.insert(std::move(slots));
    }
  }

  // 0: the arc is one of them; 1: it has indices of no two; 2: else.
  int rank(ArcId a) const {
    std::vector<std::uint32_t> slots;
    core::for_each_slot(part_.graph, a, [&](std::uint32_t slot) { slots.push_back(slot); });
    if (tuples_.count(slots) > 0) return 0;
    std::uint32_t owner = kNone;
    for (const std::uint32_t slot : slots) {
      if (owner_[slot] == kNone || owner_[slot] == kShared) continue;
      if (owner != kNone && owner != owner_[slot]) return 2;
      owner = owner_[slot];
    }
    return 1;
  }

 private:
  const BoundedComponent& part_;
  std::vector<std::uint32_t> owner_;             // [slot]: 1 + number of its tuple
  std::set<std::vector<std::uint32_t>> tuples_;  // slots of each, those of the part
};

}  // namespace

bounded::BoundedHint make_hint(const BoundedComponent& part, const WarmStart& warm) {
  if (warm.empty()) return {};
  bounded::BoundedHint hint;
  hint.u = old_multipliers(part, warm);
  if (warm.arcs.empty()) return hint;
  const OldTuples old(part, warm);
  std::vector<std::tuple<int, double, ArcId>> order;
  for (ArcId a = 0; a < part.num_arcs(); ++a)
    order.emplace_back(old.rank(a), core::reduced_cost(part.graph, hint.u, a), a);
  const std::size_t count = std::min(order.size(), kArcsPerIndex * part.rows.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  for (std::size_t n = 0; n < count; ++n) hint.arcs.push_back(std::get<ArcId>(order[n]));
  return hint;
}

}  // namespace nda::pipeline
