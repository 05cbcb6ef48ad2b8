#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <functional>
#include <vector>

inline double now_us(clockid_t clock) {
  std::timespec time{};
  clock_gettime(clock, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// Time of the processor, which other work on the machine does not lengthen; asking for it takes so
/// long that the wall clock, if less, is nearer to the truth.
inline double microseconds(const std::function<void()>& action) {
  const double processor_begin = now_us(CLOCK_PROCESS_CPUTIME_ID);
  const double wall_begin = now_us(CLOCK_MONOTONIC);
  action();
  const double wall = now_us(CLOCK_MONOTONIC) - wall_begin;
  return std::min(wall, now_us(CLOCK_PROCESS_CPUTIME_ID) - processor_begin);
}

/// Median time of `action`, each time after `prepare`, within about limit_s.
inline double median_time(double limit_s,
                          const std::function<void()>& prepare,
                          const std::function<void()>& action) {
  constexpr std::size_t kMaxRuns = 101;
  std::vector<double> times;
  double total_us = 0;
  while (times.empty() || (total_us < 1e6 * limit_s && times.size() < kMaxRuns)) {
    prepare();
    times.push_back(microseconds(action));
    total_us += times.back();
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}
