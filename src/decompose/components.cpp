#include "decompose/components.hpp"

#include <boost/graph/incremental_components.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <cstdint>
#include <numeric>

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

// Counting sort of the arcs by component.  first_slot(a) is some real slot of arc a, or kNone to
// leave it out.
template <typename FirstSlot>
Partition sort_by_component(DisjointSets& sets, std::size_t num_arcs, FirstSlot&& first_slot) {
  std::vector<std::uint32_t> label(sets.size(), kNone);
  Partition result;
  result.start.push_back(0);
  std::size_t num_kept = 0;
  for (ArcId a = 0; a < num_arcs; ++a) {
    const std::uint32_t slot = first_slot(a);
    if (slot == kNone) continue;
    ++num_kept;
    std::uint32_t& entry = label[sets.find(slot)];
    if (entry == kNone) {
      entry = static_cast<std::uint32_t>(result.num_components());
      result.start.push_back(0);
    }
    ++result.start[entry + 1];
  }
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  std::vector<std::size_t> next(result.start.begin(), result.start.end());
  result.arcs.resize(num_kept);
  for (ArcId a = 0; a < num_arcs; ++a) {
    const std::uint32_t slot = first_slot(a);
    if (slot != kNone) result.arcs[next[label[sets.find(slot)]]++] = a;
  }
  return result;
}

}  // namespace

Partition partition(const core::Component& component) {
  DisjointSets sets(component.num_slots());
  const auto first_slot = [&](ArcId a) {
    int k = 0;
    while (component.index(k, a) == 0) ++k;
    return component.slot(k, a);
  };
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    const std::uint32_t first = first_slot(a);
    core::for_each_slot(component, a, [&](std::uint32_t slot) { sets.join(first, slot); });
  }
  return sort_by_component(sets, component.num_arcs(), first_slot);
}

Partition partition(const Problem& problem, const core::Shift& shift) {
  const int n = problem.num_dimensions();
  DisjointSets sets(problem.num_indices() + static_cast<std::size_t>(n));
  const auto slot = [&](int k, ArcId a) {
    const Index i = problem.indices(k)[a];
    return i == 0 ? kNone : shift.offset[static_cast<std::size_t>(k)] + i;
  };
  const auto first_slot = [&](ArcId a) {
    if (core::shifted_cost(problem, shift, a) >= 0) return kNone;
    int k = 0;
    while (slot(k, a) == kNone) ++k;
    return slot(k, a);
  };
  for (ArcId a = 0; a < problem.num_arcs(); ++a) {
    const std::uint32_t first = first_slot(a);
    if (first == kNone) continue;
    for (int k = 0; k < n; ++k) {
      if (slot(k, a) != kNone) sets.join(first, slot(k, a));
    }
  }
  return sort_by_component(sets, problem.num_arcs(), first_slot);
}

}  // namespace nda::decompose
