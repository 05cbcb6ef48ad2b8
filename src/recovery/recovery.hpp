#pragma once

#include <memory>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/options.hpp"
#include "relax/relaxed_dual.hpp"

namespace nda::recovery {

/// A way to turn a relaxed solution into a feasible one.  One object serves one component.
class Recovery {
 public:
  virtual ~Recovery() = default;

  /// For logs: "recursive recovery", ...
  virtual const char* name() const = 0;

  /// A packing of the component of `point`, from its last evaluation; feasible always, cost <= 0.
  virtual core::Packing recover(const relax::RelaxedDual& point) = 0;
};

/// The report's recursive recovery (recovery/recursive.hpp).
std::unique_ptr<Recovery> make_recursive_recovery(const core::Component& component,
                                                  const RelaxationOptions& options,
                                                  const core::Deadline& deadline);

/// Greedy by reduced cost at the multipliers of the point (recovery/greedy.hpp).
std::unique_ptr<Recovery> make_dual_greedy_recovery(const core::Component& component,
                                                    const core::Deadline& deadline);

/// What `first` recovers, improved by descent among the arcs promising at the multipliers of the
/// point (recovery/core_search.hpp).
std::unique_ptr<Recovery> make_local_search_recovery(const core::Component& component,
                                                     std::unique_ptr<Recovery> first,
                                                     const core::Deadline& deadline);

/// The recovery of this name; the one place that knows them all.
std::unique_ptr<Recovery> make_recovery(RecoveryMethod method,
                                        const core::Component& component,
                                        const RelaxationOptions& options,
                                        const core::Deadline& deadline);

}  // namespace nda::recovery
