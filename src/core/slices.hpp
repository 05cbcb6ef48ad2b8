#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/clock.hpp"

namespace nda::core {

/// Items between two looks at the clock: some tenths of a millisecond of a pass over arcs.
inline constexpr std::size_t kSlice = 16384;

/// Calls work(i) for i = 0..count-1 in order, looking at the clock before every slice; false if the
/// deadline cut it short.
template <typename Work>
bool for_each_until(const Deadline& deadline, std::size_t count, Work&& work) {
  for (std::size_t i = 0; i < count;) {
    if (deadline.reached()) return false;
    const std::size_t end = i + std::min(kSlice, count - i);
    for (; i < end; ++i) work(i);
  }
  return true;
}

/// Sorts as std::sort does, in slices that are merged; false if the deadline left it unsorted.
/// `less` is a total order.
template <typename T, typename Less>
bool sort_until(const Deadline& deadline, std::vector<T>& items, Less less) {
  const auto at = [&](std::size_t i) {
    return items.begin() + static_cast<std::ptrdiff_t>(std::min(i, items.size()));
  };
  for (std::size_t i = 0; i < items.size(); i += kSlice) {
    if (deadline.reached()) return false;
    std::sort(at(i), at(i + kSlice), less);
  }
  for (std::size_t width = kSlice; width < items.size(); width *= 2) {
    for (std::size_t i = 0; i + width < items.size(); i += 2 * width) {
      if (deadline.reached()) return false;
      std::inplace_merge(at(i), at(i + width), at(i + 2 * width), less);
    }
  }
  return true;
}

}  // namespace nda::core
