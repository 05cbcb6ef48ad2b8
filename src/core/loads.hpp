#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "nda/types.hpp"

namespace nda::core {

/// index[0] and index[1], loaded at once: a core loads so many times a nanosecond, whatever the
/// width.
inline std::pair<Index, Index> two_indices(const Index* index) {
  static_assert(sizeof(Index) == 4);
  std::uint64_t both;
  std::memcpy(&both, index, sizeof both);
  if constexpr (std::endian::native == std::endian::big) both = std::rotl(both, 32);
  return {static_cast<Index>(both), static_cast<Index>(both >> 32)};
}

/// Asks for the cache line of base[n], to be there when it is read; base[n] need not exist.
template <typename Number>
void prefetch([[maybe_unused]] const Number* base, [[maybe_unused]] std::size_t n) {
#if defined(__GNUC__)
  __builtin_prefetch(reinterpret_cast<const void*>(  // NOLINT: may lie beyond the end
      reinterpret_cast<std::uintptr_t>(base) + n * sizeof(Number)));
  asm volatile("");  // or calls of functions that do nothing but this are left out (GCC 12)
#endif
}

}  // namespace nda::core
