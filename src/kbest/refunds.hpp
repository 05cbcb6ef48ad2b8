#pragma once

#include <vector>

#include "bnb/slack_search.hpp"
#include "core/component.hpp"
#include "cutting/master.hpp"

namespace nda::kbest {

/// A component with costs whose packings cost their slack, less that of using nothing: every arc
/// refunds the finite prices of what it uses.
///
/// @param component  whose slots and arcs are the rows and arcs of `slack`, which has no cuts.
core::Component with_refunds(const core::Component& component, const bnb::SlackProblem& slack);

/// The slack of using nothing, but for rows that must be used.
double empty_slack(const bnb::SlackProblem& slack);

/// No packing that uses up what must be has more slack than this.
double greatest_slack(const bnb::SlackProblem& slack);

/// The linear relaxation of such a component, which must outlive it: over these arcs, from the
/// multipliers that the slack comes from, rows of infinite price forced.
cutting::Master refunding_master(const core::Component& refunding,
                                 std::vector<core::ArcId> live,
                                 const bnb::SlackProblem& slack);

}  // namespace nda::kbest
