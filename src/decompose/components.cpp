#include "decompose/components.hpp"

#include <boost/graph/incremental_components.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <numeric>

#include "core/slices.hpp"

// The report (4.7) builds the layered graph of the measurements and finds its components by
// depth-first search over a spanning forest.  Storing edges would cost more memory than the arcs;
// the disjoint sets of Boost.Graph's incremental components need five bytes a vertex and see every
// arc once.

namespace nda::decompose {
namespace {

using core::ArcId;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// Vertices 0..n-1, joined arc by arc.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n)
      : rank_(n, 0), parent_(n), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void join(std::uint32_t a, std::uint32_t b) { sets_.union_set(a, b); }
  std::uint32_t find(std::uint32_t vertex) { return sets_.find_set(vertex); }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint8_t> rank_;
  std::vector<std::uint32_t> parent_;
  boost::disjoint_sets<std::uint8_t*, std::uint32_t*> sets_;
};

// Counting sort of the arcs by component.  slot_of[a] is some real slot of arc a, or kNone to leave
// it out; it becomes the component of the arc.
Partition sort_by_component(DisjointSets& sets,
                            std::vector<std::uint32_t>& slot_of,
                            const core::Deadline& deadline) {
  std::vector<std::uint32_t> label(sets.size(), kNone);
  Partition result;
  result.start.push_back(0);
  const auto count = [&](std::size_t a) {
    if (slot_of[a] == kNone) return;
    std::uint32_t& entry = label[sets.find(slot_of[a])];
    if (entry == kNone) {
      entry = static_cast<std::uint32_t>(result.num_components());
      result.start.push_back(0);
    }
    ++result.start[entry + 1];
    slot_of[a] = entry;
  };
  if (!core::for_each_until(deadline, slot_of.size(), count)) return {};
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<std::size_t> next(result.start.begin(), result.start.end());
  result.arcs.resize(result.start.back());
  const auto place = [&](std::size_t a) {
    if (slot_of[a] != kNone) result.arcs[next[slot_of[a]]++] = static_cast<ArcId>(a);
  };
  if (!core::for_each_until(deadline, slot_of.size(), place)) return {};
  return result;
}

}  // namespace

Partition partition(const core::Component& component, const core::Deadline& deadline) {
  DisjointSets sets(component.num_slots());
  std::vector<std::uint32_t> slot_of(component.num_arcs());
  const auto join = [&](std::size_t arc) {
    const ArcId a = static_cast<ArcId>(arc);
    int k = 0;
    while (component.index(k, a) == 0) ++k;
    const std::uint32_t first = slot_of[a] = component.slot(k, a);
    core::for_each_slot(component, a, [&](std::uint32_t slot) { sets.join(first, slot); });
  };
  if (!core::for_each_until(deadline, slot_of.size(), join)) return {};
  return sort_by_component(sets, slot_of, deadline);
}

Partition partition(const Problem& problem,
                    const core::Shift& shift,
                    const core::Deadline& deadline) {
  const std::size_t n = shift.offset.size();
  DisjointSets sets(problem.num_indices() + n);
  std::vector<std::uint32_t> slot_of(problem.num_arcs(), kNone);
  const auto join = [&](std::size_t a) {
    if (core::shifted_cost(problem, shift, a) >= 0) return;
    for (std::size_t k = 0; k < n; ++k) {
      const Index i = problem.indices(static_cast<int>(k))[a];
      if (i == 0) continue;
      if (slot_of[a] == kNone) slot_of[a] = shift.offset[k] + i;
      sets.join(slot_of[a], shift.offset[k] + i);
    }
  };
  if (!core::for_each_until(deadline, slot_of.size(), join)) return {};
  return sort_by_component(sets, slot_of, deadline);
}

}  // namespace nda::decompose
