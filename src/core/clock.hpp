#pragma once

#include <chrono>
#include <limits>
#include <stop_token>

namespace nda::core {

/// Wall-clock seconds since construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// A moment after which work must stop, or a request to stop; cheap to copy and to ask.
class Deadline {
 public:
  Deadline() = default;
  explicit Deadline(double limit_s, std::stop_token stop = {})
      : limit_s_(limit_s), stop_(std::move(stop)) {}

  bool interrupted() const { return stop_.stop_requested(); }
  bool expired() const { return limit_s_ < kNever && watch_.seconds() >= limit_s_; }
  bool reached() const { return interrupted() || expired(); }
  double seconds() const { return watch_.seconds(); }
  double remaining_s() const { return limit_s_ - watch_.seconds(); }
  const std::stop_token& stop() const { return stop_; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  Stopwatch watch_;
  double limit_s_ = kNever;
  std::stop_token stop_;
};

}  // namespace nda::core
