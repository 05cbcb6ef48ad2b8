#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::core {

/// A component with its dimensions in another order: dimension k is order[k] of the source.
class Permuted {
 public:
  /// Keeps a reference to the source, and copies nothing where the order is 0, 1, 2, ...
  /// Cost else: O(A N log A).
  Permuted(const Component& source, std::vector<std::size_t> order);

  /// Cut out of nothing: arc_origin is empty, slots stand for themselves.
  const Component& component() const { return is_same_ ? source_ : component_; }

  Packing to_source(Packing packing) const;
  /// By slot; nothing stays nothing.
  std::vector<double> to_source(std::span<const double> values) const;
  std::vector<double> from_source(std::span<const double> values) const;

 private:
  template <typename Visit>
  void for_each_slot_pair(Visit&& visit) const;

  const Component& source_;
  const std::vector<std::size_t> order_;
  bool is_same_ = true;
  Component component_;
  std::vector<ArcId> arcs_;  // [arc]: arc of the source
};

}  // namespace nda::core
