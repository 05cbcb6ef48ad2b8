#include "recovery/core_search.hpp"

#include <algorithm>
#include <numeric>

#include "bnb/component_slack.hpp"
#include "core/reduced_costs.hpp"
#include "recovery/greedy.hpp"
#include "recovery/local_search.hpp"
#include "recovery/pool_search.hpp"

// Good packings live where reduced costs are small.  Cutting the few promising arcs out first makes
// every move of the local search independent of the size of the component: lists are short and
// memory stays in cache.

namespace nda::recovery {

using core::ArcId;
using core::Component;
using core::Packing;

namespace {

// The smallest of a stream of (reduced cost, arc), found in memory for twice as many.
class Cheapest {
 public:
  Cheapest(double below, std::size_t limit) : below_(below), limit_(limit) {}

  void add(double r, ArcId a) {
    if (r >= below_) return;
    entries_.push_back({r, a});
    if (entries_.size() >= 2 * limit_) {
      cut();
      below_ = std::max_element(entries_.begin(), entries_.end())->first;
    }
  }

  void append_to(std::vector<ArcId>& arcs) {
    if (entries_.size() > limit_) cut();
    for (const auto& entry : entries_) arcs.push_back(entry.second);
  }

 private:
  void cut() {
    const auto middle = entries_.begin() + static_cast<std::ptrdiff_t>(limit_);
    std::nth_element(entries_.begin(), middle, entries_.end());
    entries_.erase(middle, entries_.end());
  }

  double below_;
  const std::size_t limit_;
  std::vector<std::pair<double, ArcId>> entries_;
};

// A core larger than this would no longer be quick to search, nor small beside its component.
constexpr std::size_t kMostCoreArcs = 300000;

void search_pool_of(const Component& core,
                    std::span<const double> u,
                    const CoreSearchOptions& options,
                    Packing& packing,
                    core::Random& random,
                    const core::Deadline& deadline) {
  const bnb::ComponentSlack slack = bnb::slack_of(core, u, kInfinity, deadline);
  if (deadline.reached()) return;
  const double base = std::accumulate(u.begin(), u.end(), 0.0);
  PoolSearchOptions pool;
  pool.max_work = options.neighbourhood_work;
  pool.goal = options.goal - base;
  pool.deadline = deadline;
  pool.for_all = options.for_all;
  search_pool(slack.problem, packing.arcs, pool, random);
  packing = core::make_packing(core, std::move(packing.arcs));
}

}  // namespace

std::vector<ArcId> core_arcs(const Component& component,
                             std::span<const double> u,
                             double gap,
                             std::size_t arcs_per_index,
                             std::span<const ArcId> keep,
                             const core::Deadline& deadline) {
  const std::size_t limit = std::min(arcs_per_index * component.num_indices(), kMostCoreArcs);
  Cheapest cheapest(gap, std::max<std::size_t>(1, limit));
  core::for_each_reduced_cost(
      component, u, deadline, [&](ArcId a, double r) { cheapest.add(r, a); });
  std::vector<ArcId> arcs(keep.begin(), keep.end());
  cheapest.append_to(arcs);
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  return arcs;
}

Packing greedy_in_core(const Component& component,
                       std::span<const double> u,
                       std::size_t arcs_per_index,
                       const core::Deadline& deadline) {
  const std::vector<ArcId> arcs = core_arcs(component, u, kInfinity, arcs_per_index, {}, deadline);
  core::Cutter cutter;
  const Component core = cutter.cut(component, arcs, deadline);
  Packing packing = greedy(core, core.costs, deadline);
  packing.arcs = core::at_positions(arcs, packing.arcs);
  return packing;
}

Packing search_core(const Component& component,
                    std::span<const double> u,
                    double gap,
                    const Packing& start,
                    const CoreSearchOptions& options,
                    core::Random& random,
                    const core::Deadline& deadline) {
  const std::vector<ArcId> arcs =
      core_arcs(component, u, gap, options.arcs_per_index, start.arcs, deadline);
  core::Cutter cutter;
  const Component core = cutter.cut(component, arcs, deadline);
  if (deadline.reached()) return start;
  const std::vector<double> core_u = core::restrict_slots(component, u, core);
  Packing packing = start;
  packing.arcs = core::positions_in(arcs, start.arcs);
  if (packing.arcs.empty()) packing = dual_greedy(core, core_u, deadline);
  const std::size_t size = std::min(core.num_indices(), core.num_arcs());
  const std::int64_t kicks =
      std::int64_t{options.kicks_per_index} * static_cast<std::int64_t>(size);
  LocalSearch(core, core_u, deadline).improve(packing, kicks, options.goal, random, deadline);
  if (options.neighbourhood_work > 0)
    search_pool_of(core, core_u, options, packing, random, deadline);
  if (packing.cost >= start.cost) return start;
  packing.arcs = core::at_positions(arcs, packing.arcs);
  return packing;
}

}  // namespace nda::recovery
