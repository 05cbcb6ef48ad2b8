#include "bnb/component_slack.hpp"

#include <algorithm>

#include "core/reduced_costs.hpp"

namespace nda::bnb {

using core::ArcId;

ComponentSlack slack_of(const core::Component& component,
                        std::span<const double> u,
                        double budget,
                        const core::Deadline& deadline) {
  ComponentSlack slack{SlackProblem(static_cast<std::uint32_t>(component.num_slots())), {}};
  for (const double multiplier : u) slack.problem.add_row(std::max(0.0, -multiplier));
  std::vector<RowUse> uses;
  core::for_each_reduced_cost(component, u, deadline, [&](ArcId a, double r) {
    const double reduced = std::max(0.0, r);
    if (!(reduced < budget)) return;
    uses.clear();
    core::for_each_slot(component, a, [&](std::uint32_t slot) { uses.push_back({slot, 1}); });
    slack.problem.add_arc(reduced, uses);
    slack.arcs.push_back(a);
  });
  return slack;
}

}  // namespace nda::bnb
