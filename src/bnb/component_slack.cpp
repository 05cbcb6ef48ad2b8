#include "bnb/component_slack.hpp"

#include <algorithm>
#include <utility>

#include "core/reduced_costs.hpp"

namespace nda::bnb {
namespace {

using core::ArcId;

// Room for more is made when they come: the budget may pay for next to none of many.
constexpr std::size_t kFirstArcs = 256;

// Rows first, then the arcs that the budget pays for.
class Builder {
 public:
  Builder(const core::Component& component, double budget)
      : component_(component),
        budget_(budget),
        slack_{SlackProblem(static_cast<std::uint32_t>(component.num_slots())), {}} {
    const std::size_t arcs = std::min(component.num_arcs(), kFirstArcs);
    slack_.problem.reserve(component.num_slots(), arcs, arcs * component.sizes.size());
    slack_.arcs.reserve(arcs);
    uses_.reserve(component.sizes.size());
  }

  void add_row(double price) { slack_.problem.add_row(price); }

  void add_arc(ArcId a, double reduced) {
    if (!(reduced < budget_)) return;
    uses_.clear();
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { uses_.push_back({slot, 1}); });
    slack_.problem.add_arc(reduced, uses_);
    slack_.arcs.push_back(a);
  }

  ComponentSlack take() && { return std::move(slack_); }

 private:
  const core::Component& component_;
  const double budget_;
  ComponentSlack slack_;
  std::vector<RowUse> uses_;
};

}  // namespace

ComponentSlack slack_of(const core::Component& component,
                        std::span<const double> u,
                        double budget,
                        const core::Deadline& deadline) {
  Builder slack(component, budget);
  for (const double multiplier : u) slack.add_row(std::max(0.0, -multiplier));
  core::for_each_reduced_cost(
      component, u, deadline, [&](ArcId a, double r) { slack.add_arc(a, std::max(0.0, r)); });
  return std::move(slack).take();
}

ComponentSlack slack_of(const core::Component& component,
                        std::span<const double> price,
                        std::span<const double> reduced,
                        double budget) {
  Builder slack(component, budget);
  for (const double row : price) slack.add_row(row);
  for (ArcId a = 0; a < reduced.size(); ++a) slack.add_arc(a, reduced[a]);
  return std::move(slack).take();
}

}  // namespace nda::bnb
