#include "recovery/master_search.hpp"

#include <algorithm>

#include "cutting/master_slack.hpp"
#include "recovery/pool_search.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;

constexpr double kZero = 1e-6;

// The `most` arcs of least reduced cost, ascending.
void keep_cheapest(const cutting::MasterSlack& slack, std::size_t most, std::vector<ArcId>& arcs) {
  if (arcs.size() <= most) return;
  std::nth_element(arcs.begin(),
                   arcs.begin() + static_cast<std::ptrdiff_t>(most),
                   arcs.end(),
                   [&](ArcId a, ArcId b) {
                     const double ra = slack.reduced(a);
                     const double rb = slack.reduced(b);
                     return ra != rb ? ra < rb : a < b;
                   });
  arcs.resize(most);
  std::sort(arcs.begin(), arcs.end());
}

// Adds those that are live.
void add(std::span<const ArcId> more, const cutting::Master& master, std::vector<ArcId>& arcs) {
  const std::span<const ArcId> live = master.live();
  for (const ArcId a : more) {
    if (std::binary_search(live.begin(), live.end(), a)) arcs.push_back(a);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
}

// The numbers of those of `some` that are among `arcs`.
std::vector<std::uint32_t> numbers_of(std::span<const ArcId> some, const std::vector<ArcId>& arcs) {
  std::vector<std::uint32_t> numbers;
  for (const ArcId a : some) {
    const auto at = std::lower_bound(arcs.begin(), arcs.end(), a);
    if (at != arcs.end() && *at == a)
      numbers.push_back(static_cast<std::uint32_t>(at - arcs.begin()));
  }
  return numbers;
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
  keep_cheapest(slack, options.arcs_per_index * component.num_indices(), arcs);
  add(start.arcs, master, arcs);
  for (const core::Packing& other : others) add(other.arcs, master, arcs);
  PoolSearchOptions pool;
  pool.max_work = options.max_work;
  pool.least_round_work = options.least_round_work;
  pool.goal = options.goal - slack.base();
  pool.support = numbers_of(support(master), arcs);
  for (const core::Packing& other : others) pool.starts.push_back(numbers_of(other.arcs, arcs));
  pool.deadline = deadline;
  std::vector<std::uint32_t> best = numbers_of(start.arcs, arcs);
  search_pool(slack.problem(arcs), best, pool, random);
  std::vector<ArcId> chosen;
  for (const std::uint32_t n : best) chosen.push_back(arcs[n]);
  core::Packing found = core::make_packing(component, std::move(chosen));
  return found.cost < start.cost ? found : start;
}

}  // namespace nda::recovery
