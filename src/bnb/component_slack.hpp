#pragma once

#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::bnb {

/// A component as its multipliers leave it.
struct ComponentSlack {
  SlackProblem problem;           ///< its rows are the slots
  std::vector<core::ArcId> arcs;  ///< of the component, ascending; numbered in `problem`
};

/// The slack problem of a component: the arcs that a budget pays for, those before the deadline.
/// u: feasible multipliers by slot (u <= 0, reduced costs >= 0).  Cost: O(A N).
ComponentSlack slack_of(const core::Component& component,
                        std::span<const double> u,
                        double budget,
                        const core::Deadline& deadline = {});

/// The same of prices by slot and reduced costs by arc, none of them negative.
ComponentSlack slack_of(const core::Component& component,
                        std::span<const double> price,
                        std::span<const double> reduced,
                        double budget);

}  // namespace nda::bnb
