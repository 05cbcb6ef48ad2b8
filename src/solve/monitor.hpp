#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <stop_token>

#include "core/clock.hpp"
#include "nda/options.hpp"

namespace nda::pipeline {

/// Adds up what the components report and tells the user; safe to call from several threads.
class Monitor {
 public:
  /// @param stop  asked to stop when the user's callback returns false; it is not called again
  /// then.
  Monitor(std::function<bool(const Progress&)> callback, std::stop_source stop);

  /// The components are known.
  /// @param constant        cost of choosing nothing: components report shifted costs.
  /// @param num_infeasible  components that component_feasible() will tell of; the cost is +inf
  ///                        until it has been called as often.
  void begin(double constant, std::size_t num_components, std::size_t num_infeasible);
  /// A component has its first bound.  The sum is a bound once all have one; -inf until then.
  void add_component(double lower_bound);
  /// A component's best cost and bound moved by so much.
  void moved(double cost_change, double bound_change, const char* event);
  /// A component has its first packing that leaves no index with a forbidden singleton alone.
  void component_feasible();
  /// A component's best packing is proven; the next call of moved() tells so.
  void component_done();

  /// Tells the user that work goes on if nothing was told for kHeartbeatSeconds; cheap otherwise,
  /// as only one call of kCallsPerLook looks at the clock.
  void heartbeat();

  static constexpr double kHeartbeatSeconds = 1;
  static constexpr unsigned kCallsPerLook = 8;

 private:
  void tell(const char* event);

  const std::function<bool(const Progress&)> callback_;
  std::stop_source stop_;
  core::Stopwatch watch_;
  std::atomic<double> told_s_ = 0;
  std::atomic<unsigned> asked_ = 0;
  std::mutex mutex_;
  bool stopped_ = false;
  std::size_t num_unbounded_ = 0;
  std::size_t num_infeasible_ = 0;
  double cost_sum_ = 0;
  double bound_sum_ = 0;
  Progress progress_;
};

}  // namespace nda::pipeline
