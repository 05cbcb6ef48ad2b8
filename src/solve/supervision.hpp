#pragma once

#include <functional>
#include <stop_token>

#include "core/clock.hpp"
#include "nda/options.hpp"
#include "nda/solution.hpp"
#include "solve/monitor.hpp"

namespace nda::pipeline {

/// What may stop the work on a part, the gravest first.
inline constexpr Status kReasonsToStop[] = {
    Status::kInterrupted, Status::kTimeLimit, Status::kNodeLimit, Status::kIterationLimit};

/// Of a deadline that was reached: by a request to stop or by the clock.
inline Status out_of_time(const core::Deadline& deadline) {
  return deadline.interrupted() ? Status::kInterrupted : Status::kTimeLimit;
}

/// Whom a run obeys and whom it tells: the limit of time, the caller's request to stop and the
/// callback, which may ask to stop as well.  The deadline knows of all three, and whoever asks it
/// lets the monitor tell that work goes on.
///
/// Neither copied nor moved; copies of the deadline must not outlive it.
class Supervision {
 public:
  /// @param limit_s  from now on; may be negative: then it has passed.
  Supervision(std::function<bool(const Progress&)> progress, std::stop_token stop, double limit_s)
      : forward_(std::move(stop), Forward{source_}),
        monitor_(std::move(progress), source_),
        deadline_(limit_s, source_.get_token(), &heartbeat_) {}
  Supervision(const Supervision&) = delete;
  Supervision& operator=(const Supervision&) = delete;

  Monitor& monitor() { return monitor_; }
  const core::Deadline& deadline() const { return deadline_; }
  /// The limit falls so many seconds earlier.
  void shorten(double seconds) { deadline_ = deadline_.earlier(seconds); }

 private:
  struct Forward {
    std::stop_source source;
    void operator()() { source.request_stop(); }
  };

  std::stop_source source_;
  std::stop_callback<Forward> forward_;
  Monitor monitor_;
  const std::function<void()> heartbeat_ = [this] { monitor_.heartbeat(); };
  core::Deadline deadline_;
};

}  // namespace nda::pipeline
