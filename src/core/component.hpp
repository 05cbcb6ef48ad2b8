#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda::core {

/// Number of an arc within a component.
using ArcId = std::uint32_t;

/// A problem in shifted form, the form every algorithm works on.
///
/// After the cost shift (report, 4.8) c'[a] = c[a] - sum of the singleton costs of its indices, every
/// index may stay uncovered at cost 0, and the problem reads
///
///     minimise sum c'[a] x[a]   so that   every real index is used at most once,  x binary.
///
/// A *slot* numbers the pair (dimension k, index i) as offset[k] + i, dummies included; vectors over
/// slots (multipliers, owners) have num_slots() entries, and those of the dummies stay 0.
struct Component {
  std::vector<Index> sizes;                  ///< M_k
  std::vector<std::uint32_t> offset;         ///< first slot (the dummy) of dimension k
  std::vector<std::vector<Index>> indices;   ///< [k][a], 0 = dummy; arcs in lexicographic order
  std::vector<double> costs;                 ///< shifted cost c'[a]

  /// Where a slot came from: dimension and index in the problem.
  std::vector<std::uint8_t> dimensions;      ///< [k]: dimension of the problem
  std::vector<Index> origin;                 ///< [slot]: index in the problem, 0 for dummies

  int num_dimensions() const { return static_cast<int>(sizes.size()); }
  std::size_t num_arcs() const { return costs.size(); }
  std::size_t num_slots() const {
    return sizes.empty() ? 0 : offset.back() + sizes.back() + std::size_t{1};
  }
  /// Number of real indices.
  std::size_t num_indices() const { return num_slots() - sizes.size(); }

  Index index(int k, ArcId a) const { return indices[static_cast<std::size_t>(k)][a]; }
  std::uint32_t slot(int k, ArcId a) const {
    return offset[static_cast<std::size_t>(k)] + index(k, a);
  }
};

/// Sets sizes and offset, and empties the rest.
inline Component make_component(std::vector<Index> sizes) {
  Component component;
  component.sizes = std::move(sizes);
  std::uint32_t next = 0;
  for (const Index size : component.sizes) {
    component.offset.push_back(next);
    next += size + 1;
  }
  component.indices.resize(component.sizes.size());
  return component;
}

/// c'[a] - sum of u over the slots of a.
inline double reduced_cost(const Component& component, std::span<const double> u, ArcId a) {
  double r = component.costs[a];
  for (int k = 0; k < component.num_dimensions(); ++k) r -= u[component.slot(k, a)];
  return r;
}

}  // namespace nda::core
