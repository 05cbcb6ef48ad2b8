#pragma once

#include <cstdint>
#include <functional>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "cutting/master.hpp"
#include "cutting/proof_log.hpp"

namespace nda::cutting {

/// Called with every packing found (arcs of the component), or with null and a relaxed point to
/// make one of; returns the cutoff from now on: only packings cheaper than it are looked for.
using PackingOffer = std::function<double(const Master&, const core::Packing* packing)>;

struct LeafLimits {
  double max_work = 1e6;       ///< arcs that one search may look at: some 30 ms; 0 = none
  std::int64_t max_nodes = 0;  ///< of all searches
  core::Deadline deadline;
  ProofLog* proof = nullptr;  ///< where to write searches down
};

/// Ends a node of branch and cut by enumeration (bnb/slack_search.hpp) once its multipliers are
/// good enough: what LP and cuts would take seconds to close, a search within the reduced costs
/// they found often ends in milliseconds.  Tries again only when the gap has shrunk.
class LeafSearch {
 public:
  LeafSearch(const core::Component& component, const LeafLimits& limits, const PackingOffer& offer)
      : component_(component), limits_(limits), offer_(offer) {}

  /// Searches the allowed arcs of a solved `master` for packings cheaper than `cutoff`, offers the
  /// best one, and lowers the cutoff accordingly.  Returns whether there is none below the cutoff
  /// any more; false also where the search took too long.
  bool operator()(const Master& master, double& cutoff);

  std::int64_t nodes() const { return nodes_; }

 private:
  const core::Component& component_;
  const LeafLimits limits_;
  const PackingOffer& offer_;
  double failed_gap_ = kInfinity;
  std::int64_t nodes_ = 0;
};

}  // namespace nda::cutting
