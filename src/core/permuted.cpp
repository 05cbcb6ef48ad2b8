#include "core/permuted.hpp"

#include <algorithm>

namespace nda::core {
namespace {

// The arcs of the source in the lexicographic order of the permuted dimensions.
std::vector<ArcId> sorted_arcs(const Component& source, std::span<const std::size_t> order) {
  std::vector<ArcId> arcs = all_arcs(source);
  std::sort(arcs.begin(), arcs.end(), [&](ArcId a, ArcId b) {
    for (const std::size_t k : order) {
      const Index i = source.indices[k][a];
      const Index j = source.indices[k][b];
      if (i != j) return i < j;
    }
    return a < b;
  });
  return arcs;
}

}  // namespace

Permuted::Permuted(const Component& source, std::vector<std::size_t> order)
    : source_(source), order_(std::move(order)) {
  is_same_ = std::is_sorted(order_.begin(), order_.end());
  if (is_same_) return;
  std::vector<Index> sizes;
  for (const std::size_t k : order_) sizes.push_back(source.sizes[k]);
  component_ = make_component(std::move(sizes));
  arcs_ = sorted_arcs(source, order_);
  for (const ArcId a : arcs_) component_.costs.push_back(source.costs[a]);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::span<Index> column = component_.indices[k].allocate(arcs_.size());
    for (std::size_t n = 0; n < arcs_.size(); ++n) column[n] = source.indices[order_[k]][arcs_[n]];
  }
}

Packing Permuted::to_source(Packing packing) const {
  if (is_same_) return packing;
  return make_packing(source_, at_positions(arcs_, packing.arcs));
}

// Calls visit(slot of the source, slot of the component), dummies included.
template <typename Visit>
void Permuted::for_each_slot_pair(Visit&& visit) const {
  for (std::size_t k = 0; k < order_.size(); ++k) {
    for (Index i = 0; i <= component().sizes[k]; ++i)
      visit(source_.offset[order_[k]] + i, component().offset[k] + i);
  }
}

std::vector<double> Permuted::to_source(std::span<const double> values) const {
  if (is_same_ || values.empty()) return {values.begin(), values.end()};
  std::vector<double> result(values.size());
  for_each_slot_pair([&](std::size_t slot, std::size_t own) { result[slot] = values[own]; });
  return result;
}

std::vector<double> Permuted::from_source(std::span<const double> values) const {
  if (is_same_ || values.empty()) return {values.begin(), values.end()};
  std::vector<double> result(values.size());
  for_each_slot_pair([&](std::size_t slot, std::size_t own) { result[own] = values[slot]; });
  return result;
}

}  // namespace nda::core
