#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <stop_token>
#include <utility>

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

  /// `heartbeat` (may be null, must outlive all copies) is called by whoever asks reached(): as all
  /// long work asks every few milliseconds, that is a clock without a thread.
  explicit Deadline(double limit_s,
                    std::stop_token stop = {},
                    const std::function<void()>* heartbeat = nullptr)
      : limit_s_(limit_s), stop_(std::move(stop)), heartbeat_(heartbeat) {}

  bool interrupted() const { return stop_.stop_requested(); }
  bool expired() const { return limit_s_ < kNever && watch_.seconds() >= limit_s_; }
  bool reached() const {
    if (heartbeat_ != nullptr) (*heartbeat_)();
    return interrupted() || expired();
  }
  double seconds() const { return watch_.seconds(); }
  double remaining_s() const { return limit_s_ - watch_.seconds(); }
  const std::stop_token& stop() const { return stop_; }

  /// The same with so many seconds less.
  Deadline earlier(double seconds) const {
    Deadline result = *this;
    result.limit_s_ -= seconds;
    return result;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  Stopwatch watch_;
  double limit_s_ = kNever;
  std::stop_token stop_;
  const std::function<void()>* heartbeat_ = nullptr;
};

}  // namespace nda::core
