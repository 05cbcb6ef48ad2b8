#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/component.hpp"

namespace nda::core {

/// Keeps the `most` arcs of least key(arc), ascending, of equal ones the first; all, as they are,
/// where there are no more.  Cost: one call of `key` for each, and linear on average.
template <typename Key>
void keep_cheapest(std::vector<ArcId>& arcs, std::size_t most, Key&& key) {
  if (arcs.size() <= most) return;
  std::vector<std::pair<double, ArcId>> keyed;
  keyed.reserve(arcs.size());
  for (const ArcId a : arcs) keyed.emplace_back(key(a), a);
  std::nth_element(keyed.begin(), keyed.begin() + static_cast<std::ptrdiff_t>(most), keyed.end());
  arcs.resize(most);
  for (std::size_t n = 0; n < most; ++n) arcs[n] = keyed[n].second;
  std::sort(arcs.begin(), arcs.end());
}

}  // namespace nda::core
