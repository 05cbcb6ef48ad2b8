#include "solve/monitor.hpp"

namespace nda::pipeline {

Monitor::Monitor(std::function<bool(const Progress&)> callback, std::stop_source stop)
    : callback_(std::move(callback)), stop_(std::move(stop)) {}

void Monitor::begin(double constant, std::size_t num_components, std::size_t num_infeasible) {
  const std::lock_guard lock(mutex_);
  num_unbounded_ = num_components;
  num_infeasible_ = num_infeasible;
  cost_sum_ = bound_sum_ = constant;
  progress_.num_components = num_components;
}

void Monitor::add_component(double lower_bound) {
  const std::lock_guard lock(mutex_);
  bound_sum_ += lower_bound;
  if (--num_unbounded_ == 0) progress_.lower_bound = bound_sum_;
}

void Monitor::moved(double cost_change, double bound_change, const char* event) {
  const std::lock_guard lock(mutex_);
  cost_sum_ += cost_change;
  if (num_infeasible_ == 0) progress_.cost = cost_sum_;
  bound_sum_ += bound_change;
  if (num_unbounded_ == 0) progress_.lower_bound = bound_sum_;
  tell(event);
}

void Monitor::component_feasible() {
  const std::lock_guard lock(mutex_);
  --num_infeasible_;
}

void Monitor::component_done() {
  const std::lock_guard lock(mutex_);
  ++progress_.components_done;
}

void Monitor::heartbeat() {
  if (!callback_ || asked_.fetch_add(1, std::memory_order_relaxed) % kCallsPerLook != 0) return;
  if (watch_.seconds() < told_s_ + kHeartbeatSeconds) return;
  const std::lock_guard lock(mutex_);
  if (watch_.seconds() >= told_s_ + kHeartbeatSeconds) tell("working");
}

void Monitor::tell(const char* event) {
  if (!callback_ || stopped_) return;
  progress_.seconds = watch_.seconds();
  told_s_ = progress_.seconds;
  progress_.event = event;
  if (callback_(progress_)) return;
  stopped_ = true;
  stop_.request_stop();
}

}  // namespace nda::pipeline
