#include "kbest/bounded_neighbours.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

#include "core/slices.hpp"

namespace nda::kbest {
namespace {

using bounded::BoundedComponent;
using bounded::Row;
using core::ArcId;

class Neighbourhood {
 public:
  Neighbourhood(const BoundedComponent& component, std::span<const ArcId> best)
      : component_(component),
        uses_(bounded::count_uses(component.graph, best)),
        on_(core::list_by_slot(component.graph, best)),
        is_used_(component.num_arcs(), 0) {
    for (const ArcId a : best) is_used_[a] = 1;
  }

  // +inf where that is no solution.
  BoundedNeighbour with(ArcId a) const {
    std::vector<ArcId> changed = {a};
    if (is_used_[a] == 0) {
      core::for_each_slot(component_.graph, a, [&](std::uint32_t slot) {
        if (uses_[slot] < component_.rows[slot].hi) return;
        const ArcId out = cheapest_to_leave(slot);
        if (out != kNoArc && std::find(changed.begin(), changed.end(), out) == changed.end())
          changed.push_back(out);
      });
      std::sort(changed.begin(), changed.end());
    }
    return {rise_of(changed), std::move(changed)};
  }

 private:
  static constexpr ArcId kNoArc = ~ArcId{0};

  static double cost(const Row& row, int uses) {
    if (uses > static_cast<int>(row.hi)) return kInfinity;
    if (row.is_forced && uses < static_cast<int>(row.lo)) return kInfinity;
    return row.cost(static_cast<Index>(uses));
  }

  double rise_of(std::span<const ArcId> changed) const {
    double rise = 0;
    std::map<std::uint32_t, int> more;
    for (const ArcId a : changed) {
      const int sign = is_used_[a] != 0 ? -1 : 1;
      rise += sign * component_.graph.costs[a];
      core::for_each_slot(component_.graph, a, [&](std::uint32_t slot) { more[slot] += sign; });
    }
    for (const auto& [slot, change] : more) {
      const Row& row = component_.rows[slot];
      const int uses = static_cast<int>(uses_[slot]);
      rise += cost(row, uses + change) - row.cost(uses_[slot]);
    }
    return rise;
  }

  ArcId cheapest_to_leave(std::uint32_t slot) const {
    const std::span<const ArcId> arcs = on_[slot];
    if (arcs.empty()) return kNoArc;
    return *std::min_element(arcs.begin(), arcs.end(), [&](ArcId a, ArcId b) {
      return rise_of(std::span(&a, 1)) < rise_of(std::span(&b, 1));
    });
  }

  const BoundedComponent& component_;
  const std::vector<Index> uses_;      // [slot]
  const core::Lists<ArcId> on_;        // [slot]: arcs used
  std::vector<std::uint8_t> is_used_;  // [arc]
};

}  // namespace

std::vector<BoundedNeighbour> bounded_neighbours(const BoundedComponent& component,
                                                 std::span<const ArcId> best,
                                                 const core::Deadline& deadline) {
  const Neighbourhood neighbourhood(component, best);
  std::vector<BoundedNeighbour> found;
  core::for_each_until(deadline, component.num_arcs(), [&](std::size_t a) {
    BoundedNeighbour one = neighbourhood.with(static_cast<ArcId>(a));
    if (one.rise < kInfinity) found.push_back(std::move(one));
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return std::tie(a.rise, a.changed) < std::tie(b.rise, b.changed);
  });
  return found;
}

std::vector<ArcId> arcs_of(const BoundedNeighbour& neighbour, std::span<const ArcId> best) {
  std::vector<ArcId> arcs;
  std::set_symmetric_difference(best.begin(),
                                best.end(),
                                neighbour.changed.begin(),
                                neighbour.changed.end(),
                                std::back_inserter(arcs));
  return arcs;
}

}  // namespace nda::kbest
