#pragma once

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

/// Counts allocations and their bytes.  Replaces operator new, so include it in exactly one source
/// of an executable.
namespace nda::support {

inline std::atomic<std::size_t> num_allocations{0};
inline std::atomic<std::size_t> live_bytes{0};
inline std::atomic<std::size_t> peak_live_bytes{0};

/// Calls of operator new during `action`.
template <class Action>
std::size_t count_allocations(const Action& action) {
  const std::size_t before = num_allocations;
  action();
  return num_allocations - before;
}

/// The most bytes that `action` held at once, single-threaded, beyond those held before.
template <class Action>
std::size_t most_bytes_held(const Action& action) {
  const std::size_t before = live_bytes;
  peak_live_bytes = before;
  action();
  return peak_live_bytes - before;
}

inline void* counted_malloc(std::size_t size) {
  ++num_allocations;
  void* memory = std::malloc(size == 0 ? 1 : size);
  live_bytes += malloc_usable_size(memory);
  if (live_bytes > peak_live_bytes) peak_live_bytes = live_bytes.load();
  return memory;
}

inline void* counted_allocation(std::size_t size) {
  if (void* memory = counted_malloc(size)) return memory;
  throw std::bad_alloc();
}

inline void counted_free(void* memory) {
  live_bytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace nda::support

void* operator new(std::size_t size) {
  return nda::support::counted_allocation(size);
}
void* operator new[](std::size_t size) {
  return nda::support::counted_allocation(size);
}
// What std::stable_sort asks.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return nda::support::counted_malloc(size);
}
void operator delete(void* memory) noexcept {
  nda::support::counted_free(memory);
}
void operator delete[](void* memory) noexcept {
  nda::support::counted_free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  nda::support::counted_free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  nda::support::counted_free(memory);
}
