#pragma once

#include <cstddef>
#include <functional>
#include <thread>
#include <vector>

namespace nda::support {

/// Ways for core::ForAll in which nothing may come out otherwise than in turn: the last first, and
/// a thread for each.
inline void backwards(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = count; i-- > 0;) work(i);
}

inline void at_once(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::jthread> threads;
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back([&work, i] { work(i); });
}

}  // namespace nda::support
