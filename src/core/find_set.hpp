#pragma once

#include <cstdint>
#include <span>

namespace nda::core {

/// Disjoint sets as a forest: the root of the tree that an element stands in.  Halves the way there
/// for those who come after.  Who joins two sets makes one root the parent of the other.
/// @param parent  [element]; roots are their own
inline std::uint32_t find_set(std::span<std::uint32_t> parent, std::uint32_t element) {
  while (parent[element] != element) element = parent[element] = parent[parent[element]];
  return element;
}

}  // namespace nda::core
