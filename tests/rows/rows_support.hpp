#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/component.hpp"
#include "core/random.hpp"
#include "cutting/cut.hpp"

namespace nda::rows {

/// `cut` with all its arcs of the component.
inline cutting::CutRow row_of(const core::Component& component, const cutting::Cut& cut) {
  const cutting::SlotIndex index(component, core::all_arcs(component));
  return {cut, cutting::CutLister(component.num_arcs()).list(cut, index), 0, 0};
}

/// Real indices of a component, by slot.
inline std::vector<std::uint32_t> real_slots(const core::Component& component) {
  std::vector<std::uint32_t> slots;
  core::for_each_index(component,
                       [&](std::uint32_t slot, std::size_t, Index) { slots.push_back(slot); });
  return slots;
}

/// Rows of random cuts over three indices, and some over more with unequal weights.
inline std::vector<cutting::CutRow> random_rows(const core::Component& component,
                                                std::size_t count,
                                                core::Random& random) {
  std::vector<cutting::CutRow> rows;
  while (rows.size() < count) {
    std::vector<std::uint32_t> slots = real_slots(component);
    core::shuffle(slots, random);
    const bool is_clique = random.below(3) > 0;
    slots.resize(std::min<std::size_t>(slots.size(), is_clique ? 3 : 5));
    std::sort(slots.begin(), slots.end());
    cutting::Cut cut{slots, std::vector<std::uint8_t>(slots.size(), 1), 2};
    if (!is_clique) cut.divisor = 3;
    for (std::uint8_t& weight : cut.weights)
      weight = static_cast<std::uint8_t>(is_clique ? 1 : 1 + random.below(2));
    rows.push_back(row_of(component, cut));
  }
  return rows;
}

/// Every cut over three indices as a row.
inline std::vector<cutting::CutRow> all_cliques(const core::Component& component) {
  const std::vector<std::uint32_t> slots = real_slots(component);
  std::vector<cutting::CutRow> rows;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    for (std::size_t j = i + 1; j < slots.size(); ++j) {
      for (std::size_t k = j + 1; k < slots.size(); ++k)
        rows.push_back(row_of(component, {{slots[i], slots[j], slots[k]}, {1, 1, 1}, 2}));
    }
  }
  return rows;
}

}  // namespace nda::rows
