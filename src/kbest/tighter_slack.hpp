#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bnb/component_slack.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::kbest {

/// Another slack of the same packings, which leaves one of them less where it can: by the linear
/// relaxation, and cuts as long as they pay.  The slacks of two packings differ by as much as
/// before, but for rounding.
///
/// @param component  whose slots and arcs are the rows and arcs of `slack`.
/// @param slack      without cuts; a price of +inf forbids to leave a slot alone.
/// @param best       a packing of least slack.
/// @param reach      arcs that are in no packing whose slack exceeds that of `best` by less may be
///                   missing.
/// @param max_rounds of cuts, at most.
/// @return           rows are slots, then cuts; nothing where the deadline strikes, or the linear
/// program fails.
///
/// Cost: a linear program of the component's arcs, again with every round of cuts.
std::optional<bnb::ComponentSlack> tighter_slack(const core::Component& component,
                                                 const bnb::SlackProblem& slack,
                                                 std::span<const core::ArcId> best,
                                                 double reach,
                                                 int max_rounds,
                                                 const core::Deadline& deadline);

}  // namespace nda::kbest
