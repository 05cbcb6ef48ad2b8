#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

/// Counts allocations.  Replaces operator new, so include it in exactly one source of an
/// executable.
namespace nda::support {

inline std::atomic<std::size_t> num_allocations{0};

/// Calls of operator new during `action`.
template <class Action>
std::size_t count_allocations(const Action& action) {
  const std::size_t before = num_allocations;
  action();
  return num_allocations - before;
}

inline void* counted_allocation(std::size_t size) {
  ++num_allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
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
  ++nda::support::num_allocations;
  return std::malloc(size == 0 ? 1 : size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
