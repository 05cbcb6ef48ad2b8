#pragma once

#include <functional>
#include <mutex>
#include <stop_token>

#include "core/clock.hpp"
#include "nda/options.hpp"

namespace nda::pipeline {

/// Adds up what the components report and tells the user; safe to call from several threads.
class Monitor {
 public:
  /// @param constant        cost of choosing nothing: components report shifted costs.
  /// @param num_infeasible  components that component_feasible() will tell of; the cost is +inf
  ///                        until it has been called as often.
  /// @param stop            asked to stop when the user's callback returns false; it is not called
  ///                        again then.
  Monitor(const std::function<bool(const Progress&)>& callback,
          double constant,
          std::size_t num_components,
          std::size_t num_infeasible,
          std::stop_source stop);

  /// A component has its first bound.  The sum is a bound once all have one; -inf until then.
  void add_component(double lower_bound);
  /// A component's best cost and bound moved by so much.
  void moved(double cost_change, double bound_change, const char* event);
  /// A component has its first packing that leaves no index with a forbidden singleton alone.
  void component_feasible();
  /// A component's best packing is proven; the next call of moved() tells so.
  void component_done();

 private:
  void tell(const char* event);

  const std::function<bool(const Progress&)>& callback_;
  std::stop_source stop_;
  core::Stopwatch watch_;
  std::mutex mutex_;
  bool stopped_ = false;
  std::size_t num_unbounded_;
  std::size_t num_infeasible_;
  double cost_sum_;
  double bound_sum_;
  Progress progress_;
};

}  // namespace nda::pipeline
