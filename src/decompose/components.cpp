#include "decompose/components.hpp"

#include <algorithm>
#include <boost/graph/incremental_components.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <numeric>

#include "core/slices.hpp"

// The report (4.7) builds the layered graph of the measurements and finds its components by
// depth-first search over a spanning forest.  Storing edges would cost more memory than the arcs;
// the disjoint sets of Boost.Graph's incremental components need nine bytes a vertex and see every
// arc once.

namespace nda::decompose {
namespace {

using core::ArcId;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// Vertices 0..n-1, joined arc by arc.  Arcs are in lexicographic order, so the arcs of one first
// vertex come together, and most of what they join is joined already.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n)
      : rank_(n, 0), parent_(n), joined_to_(n, kNone), sets_(rank_.data(), parent_.data()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  void join(std::uint32_t first, std::uint32_t other) {
    if (joined_to_[other] == first) return;
    joined_to_[other] = first;
    sets_.union_set(first, other);
  }
  std::uint32_t find(std::uint32_t vertex) { return sets_.find_set(vertex); }
  std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint8_t> rank_;
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint32_t> joined_to_;  // [vertex]: the first vertex that it was last joined to
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

// One dimension: the index of every arc, the slot of the dummy.
struct Dimension {
  const Index* index;
  std::uint32_t offset;
};

// A dummy is replaced by the first vertex, which joins nothing: that is quicker than a jump.
template <typename Keep>
Partition partition_arcs(std::span<const Dimension> dimensions,
                         std::size_t num_slots,
                         std::size_t num_arcs,
                         const core::Deadline& deadline,
                         Keep&& keep) {
  DisjointSets sets(num_slots);
  std::vector<std::uint32_t> slot_of(num_arcs, kNone);
  const auto join = [&](std::size_t a) {
    if (!keep(a)) return;
    auto dimension = dimensions.begin();
    while (dimension->index[a] == 0) ++dimension;
    const std::uint32_t first = slot_of[a] = dimension->offset + dimension->index[a];
    while (++dimension != dimensions.end()) {
      const Index i = dimension->index[a];
      sets.join(first, i == 0 ? first : dimension->offset + i);
    }
  };
  if (!core::for_each_until(deadline, num_arcs, join)) return {};
  return sort_by_component(sets, slot_of, deadline);
}

}  // namespace

void join(Partition& partition) {
  std::sort(partition.arcs.begin(), partition.arcs.end());
  if (!partition.arcs.empty()) partition.start = {0, partition.arcs.size()};
}

Partition partition(const core::Component& component, const core::Deadline& deadline) {
  std::vector<Dimension> dimensions;
  for (std::size_t k = 0; k < component.sizes.size(); ++k) {
    dimensions.push_back({component.indices[k].data(), component.offset[k]});
  }
  const auto keep = [](std::size_t) { return true; };
  return partition_arcs(dimensions, component.num_slots(), component.num_arcs(), deadline, keep);
}

Partition partition(const Problem& problem,
                    const core::Shift& shift,
                    const core::Deadline& deadline) {
  std::vector<Dimension> dimensions;
  for (std::size_t k = 0; k < shift.offset.size(); ++k) {
    dimensions.push_back({problem.indices(static_cast<int>(k)).data(), shift.offset[k]});
  }
  const auto keep = [&](std::size_t a) { return core::shifted_cost(problem, shift, a) < 0; };
  return partition_arcs(
      dimensions, problem.num_indices() + dimensions.size(), problem.num_arcs(), deadline, keep);
}

}  // namespace nda::decompose
