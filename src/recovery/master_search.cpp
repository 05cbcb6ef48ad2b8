#include "recovery/master_search.hpp"

#include <algorithm>
#include <utility>

#include "core/cheapest.hpp"
#include "cutting/master_slack.hpp"
#include "recovery/pool_search.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;

constexpr double kZero = 1e-6;

// Adds those that are live.
void add(std::vector<ArcId> more, const cutting::Master& master, std::vector<ArcId>& arcs) {
  const std::span<const ArcId> live = master.live();
  std::erase_if(more, [&](ArcId a) { return !std::binary_search(live.begin(), live.end(), a); });
  arcs.insert(arcs.end(), more.begin(), more.end());
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
}

// The arcs that the solved point uses.
std::vector<ArcId> support(const cutting::Master& master) {
  std::vector<ArcId> arcs;
  for (std::size_t k = 0; k < master.arcs().size(); ++k) {
    if (master.values()[k] > kZero) arcs.push_back(master.arcs()[k]);
  }
  return arcs;
}

}  // namespace

core::Packing search_by_master(const core::Component& component,
                               const cutting::Master& master,
                               const core::Packing& start,
                               const std::vector<core::Packing>& others,
                               const MasterSearchOptions& options,
                               core::Random& random,
                               const core::Deadline& deadline) {
  const cutting::MasterSlack slack(component, master);
  std::vector<ArcId> arcs = slack.affordable(start.cost - slack.base());
  core::keep_cheapest(arcs, options.arcs_per_index * component.num_indices(), [&](ArcId a) {
    return slack.reduced(a);
  });
  std::vector<ArcId> of_packings = start.arcs;
  for (const core::Packing& other : others)
    of_packings.insert(of_packings.end(), other.arcs.begin(), other.arcs.end());
  add(std::move(of_packings), master, arcs);
  PoolSearchOptions pool;
  pool.max_work = options.max_work;
  pool.least_round_work = options.least_round_work;
  pool.swap_work = options.swap_work;
  pool.goal = options.goal - slack.base();
  pool.support = core::positions_in(arcs, support(master));
  for (const core::Packing& other : others)
    pool.starts.push_back(core::positions_in(arcs, other.arcs));
  pool.deadline = deadline;
  pool.for_all = options.for_all;
  std::vector<std::uint32_t> best = core::positions_in(arcs, start.arcs);
  search_pool(slack.problem(arcs), best, pool, random);
  core::Packing found = core::make_packing(component, core::at_positions(arcs, best));
  return found.cost < start.cost ? found : start;
}

}  // namespace nda::recovery
