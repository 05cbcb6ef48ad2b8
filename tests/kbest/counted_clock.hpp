#pragma once

#include <functional>
#include <stop_token>
#include <utility>

#include "core/clock.hpp"
#include "nda/types.hpp"

namespace nda::kbest {

/// A deadline that counts who looks at it, and strikes at the look that `strikes` says: the first
/// one is number 1.
class CountedClock {
 public:
  explicit CountedClock(std::function<bool(int look)> strikes) : strikes_(std::move(strikes)) {}
  CountedClock(const CountedClock&) = delete;
  CountedClock& operator=(const CountedClock&) = delete;

  const core::Deadline& deadline() const { return deadline_; }
  int looks() const { return looks_; }
  bool has_struck() const { return source_.stop_requested(); }

 private:
  void look() {
    if (strikes_(++looks_)) source_.request_stop();
  }

  std::function<bool(int)> strikes_;
  int looks_ = 0;
  std::stop_source source_;
  const std::function<void()> heartbeat_ = [this] { look(); };
  core::Deadline deadline_{kInfinity, source_.get_token(), &heartbeat_};
};

}  // namespace nda::kbest
