#include "recovery/recovery.hpp"

#include <vector>

#include "recovery/core_search.hpp"
#include "recovery/greedy.hpp"
#include "recovery/recursive.hpp"

namespace nda::recovery {
namespace {

using core::Component;
using core::Deadline;
using core::Packing;
using relax::RelaxedDual;

class RecursiveRecovery : public Recovery {
 public:
  RecursiveRecovery(const Component& component,
                    const RelaxationOptions& options,
                    const Deadline& deadline)
      : component_(component), options_(options), deadline_(deadline) {}

  const char* name() const override { return "recursive recovery"; }
  Packing recover(const RelaxedDual& point) override {
    return recover_recursively(component_, point, options_, deadline_);
  }

 private:
  const Component& component_;
  const RelaxationOptions options_;
  const Deadline deadline_;
};

std::vector<double> feasible_multipliers(const Component& component,
                                         const RelaxedDual& point,
                                         const Deadline& deadline) {
  std::vector<double> u(component.num_slots());
  point.multipliers(u);
  relax::make_feasible(component, u, deadline);
  return u;
}

class DualGreedyRecovery : public Recovery {
 public:
  DualGreedyRecovery(const Component& component, const Deadline& deadline)
      : component_(component), deadline_(deadline) {}

  const char* name() const override { return "dual-guided greedy"; }
  Packing recover(const RelaxedDual& point) override {
    return dual_greedy(component_, feasible_multipliers(component_, point, deadline_), deadline_);
  }

 private:
  const Component& component_;
  const Deadline deadline_;
};

class LocalSearchRecovery : public Recovery {
 public:
  LocalSearchRecovery(const Component& component,
                      std::unique_ptr<Recovery> first,
                      const Deadline& deadline)
      : component_(component), first_(std::move(first)), deadline_(deadline), random_(1) {}

  const char* name() const override { return "local search"; }
  Packing recover(const RelaxedDual& point) override {
    const Packing start = first_->recover(point);
    const std::vector<double> u = feasible_multipliers(component_, point, deadline_);
    CoreSearchOptions options;
    options.kicks_per_index = 0;
    double lower = 0;
    for (const double multiplier : u) lower += multiplier;
    return search_core(component_, u, start.cost - lower, start, options, random_, deadline_);
  }

 private:
  const Component& component_;
  const std::unique_ptr<Recovery> first_;
  const Deadline deadline_;
  core::Random random_;
};

}  // namespace

std::unique_ptr<Recovery> make_recursive_recovery(const Component& component,
                                                  const RelaxationOptions& options,
                                                  const Deadline& deadline) {
  return std::make_unique<RecursiveRecovery>(component, options, deadline);
}

std::unique_ptr<Recovery> make_dual_greedy_recovery(const Component& component,
                                                    const Deadline& deadline) {
  return std::make_unique<DualGreedyRecovery>(component, deadline);
}

std::unique_ptr<Recovery> make_local_search_recovery(const Component& component,
                                                     std::unique_ptr<Recovery> first,
                                                     const Deadline& deadline) {
  return std::make_unique<LocalSearchRecovery>(component, std::move(first), deadline);
}

std::unique_ptr<Recovery> make_recovery(RecoveryMethod method,
                                        const Component& component,
                                        const RelaxationOptions& options,
                                        const Deadline& deadline) {
  switch (method) {
    case RecoveryMethod::kDualGreedy:
      return make_dual_greedy_recovery(component, deadline);
    case RecoveryMethod::kLocalSearch:
      return make_local_search_recovery(
          component, make_recursive_recovery(component, options, deadline), deadline);
    case RecoveryMethod::kRecursive:
      break;
  }
  return make_recursive_recovery(component, options, deadline);
}

}  // namespace nda::recovery
