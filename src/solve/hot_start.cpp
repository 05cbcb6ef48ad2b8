#include "solve/hot_start.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/slices.hpp"
#include "decompose/exchange_fixing.hpp"
#include "recovery/combine.hpp"
#include "recovery/greedy.hpp"
#include "relax/ascent.hpp"
#include "relax/prices.hpp"

// A window moved by one scan keeps its picture but hardly a cost: births and trailing misses shift
// them all, and what was charged to the scan that left must be charged elsewhere.  So nothing of
// the last solution is true any more, but all of it nearly is.  The old multipliers, with those of
// the new scan set to what its arcs pay, leave most arcs with a reduced cost that no small change
// will bring down.  The others, a few per index, are the active arcs: coordinate ascent on them
// costs next to nothing, and one pass over the rest tells whether that was fair.  The old arcs say
// who belongs together; the best continuations of each, and the arcs of least reduced cost, make
// packings.  Where packing and multipliers meet, everything is settled; only around the places
// where they do not, arcs stay open (decompose/exchange_fixing.hpp), and the same is done once
// more with these.  What is then still open is split and solved.

namespace nda::pipeline {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

// Arcs of least reduced cost: those that coordinate ascent sees, so many of an index or this share
// of all, and those that packings are made of.
constexpr std::size_t kActivePerIndex = 3;
constexpr std::size_t kActiveShare = 8;
constexpr std::size_t kNearPerIndex = 1;
constexpr std::size_t kSample = 250;
// Ascent ends after so many sweeps, or when no multiplier moves by this share of the largest cost.
constexpr int kSweeps = 7;
constexpr int kMoreSweeps = 30;  // for the arcs that are still open
constexpr double kLeastMove = 1e-4;
// Old tuples are continued where the gap is wider, as a share of the cost.
constexpr double kWideGap = 0.01;
// Of the margin, for one fixing: what two of them exclude and rounding adds stays below it.
constexpr double kToleranceShare = 0.125;

// The arcs that improve on their singletons.  Slots are those of the problem.
Component live_part(const Problem& problem,
                    const core::Shift& shift,
                    const core::Deadline& deadline) {
  Component live = core::make_component({problem.sizes().begin(), problem.sizes().end()});
  std::size_t count = 0;
  for (std::size_t first = 0; first < problem.num_arcs(); first += core::kSlice) {
    if (deadline.reached()) return {};
    const std::size_t end = std::min(first + core::kSlice, problem.num_arcs());
    live.costs.resize(count + end - first);
    live.arc_origin.resize(count + end - first);
    for (std::size_t a = first; a < end; ++a) {  // without a jump, which nothing foretells
      live.costs[count] = core::shifted_cost(problem, shift, a);
      live.arc_origin[count] = static_cast<ArcId>(a);
      count += live.costs[count] < 0;
    }
  }
  live.costs.resize(count);
  live.arc_origin.resize(count);
  for (std::size_t k = 0; k < live.sizes.size() && !deadline.reached(); ++k) {
    const std::span<const Index> column = problem.indices(static_cast<int>(k));
    const std::span<Index> copy = live.indices[k].allocate(live.num_arcs());
    for (ArcId a = 0; a < copy.size(); ++a) copy[a] = column[live.arc_origin[a]];
  }
  return live;
}

// Old multipliers by slot, none below the cheapest arc; marks the slots that have none.
std::vector<double> old_multipliers(const Component& live,
                                    const core::Shift& shift,
                                    const WarmStart& warm,
                                    std::vector<char>& is_new) {
  const double least = *std::min_element(live.costs.begin(), live.costs.end());
  std::vector<double> u(live.num_slots(), 0.0);
  is_new.assign(live.num_slots(), 0);
  core::for_each_index(live, [&](std::uint32_t slot, std::size_t k, Index i) {
    const bool known = k < warm.multipliers.size() && i <= warm.multipliers[k].size() &&
                       std::isfinite(warm.multipliers[k][i - 1]);
    is_new[slot] = !known;
    if (known) u[slot] = std::clamp(warm.multipliers[k][i - 1] - shift.base[k][i], least, 0.0);
  });
  return u;
}

// About so many arcs of least reduced cost, all of those up to a bound that a sample suggests.
std::vector<ArcId> cheapest_arcs(std::span<const double> reduced, std::size_t count) {
  std::vector<ArcId> cheapest;
  double bound = kInfinity;
  if (count < reduced.size()) {
    const std::size_t step = 1 + reduced.size() / kSample;
    std::vector<double> sample;
    for (std::size_t a = 0; a < reduced.size(); a += step) sample.push_back(reduced[a]);
    const auto middle =
        sample.begin() + static_cast<std::ptrdiff_t>(count * sample.size() / reduced.size());
    std::nth_element(sample.begin(), middle, sample.end());
    bound = *middle;
  }
  cheapest.resize(reduced.size());
  std::size_t size = 0;
  for (ArcId a = 0; a < reduced.size(); ++a) {  // without a jump
    cheapest[size] = a;
    size += reduced[a] <= bound;
  }
  cheapest.resize(size);
  return cheapest;
}

// By slot: 1 + the number of the old tuple that it belongs to, the last of several; 0 = none.
std::vector<std::uint32_t> old_tuples(const Component& live, const WarmStart& warm) {
  std::vector<std::uint32_t> tuple_of(live.num_slots(), 0);
  for (std::uint32_t t = 0; t < warm.arcs.size(); ++t) {
    const std::vector<Index>& tuple = warm.arcs[t];
    for (std::size_t k = 0; k < std::min(live.sizes.size(), tuple.size()); ++k) {
      if (tuple[k] > 0 && tuple[k] <= live.sizes[k]) tuple_of[live.offset[k] + tuple[k]] = t + 1;
    }
  }
  return tuple_of;
}

// 1 + the number of the one old tuple that the indices of an arc belong to; 0 = none or several.
std::uint32_t continued(const Component& live, std::span<const std::uint32_t> tuple_of, ArcId a) {
  std::uint32_t owner = 0;
  for (int k = 0; k < live.num_dimensions(); ++k) {
    const std::uint32_t tuple = tuple_of[live.slot(k, a)];
    if (tuple == 0) continue;
    if (owner != 0 && owner != tuple) return 0;
    owner = tuple;
  }
  return owner;
}

// The cheapest arc of every old tuple with every index of the last dimension, and with none.
std::vector<ArcId> continuations(const Component& live,
                                 std::span<const std::uint32_t> tuple_of,
                                 std::size_t num_tuples) {
  std::vector<std::uint32_t> owner(live.num_arcs());
  for (ArcId a = 0; a < owner.size(); ++a) owner[a] = continued(live, tuple_of, a);
  const core::Lists<ArcId> arcs_of(num_tuples + 1, [&](auto&& visit) {
    for (ArcId a = 0; a < owner.size(); ++a) {
      if (owner[a] != 0) visit(owner[a], a);
    }
  });
  constexpr ArcId kNone = ~ArcId{0};
  const std::span<const Index> last = {live.indices.back().data(), live.num_arcs()};
  std::vector<ArcId> cheapest(live.sizes.back() + std::size_t{1}, kNone);
  std::vector<ArcId> found;
  for (std::size_t t = 1; t <= num_tuples; ++t) {
    for (const ArcId a : arcs_of[t]) {
      ArcId& best = cheapest[last[a]];
      if (best == kNone || live.costs[a] < live.costs[best]) best = a;
    }
    for (const ArcId a : arcs_of[t]) {
      if (const ArcId best = std::exchange(cheapest[last[a]], kNone); best != kNone)
        found.push_back(best);
    }
  }
  return found;
}

// What ascent, pricing and packings find out of a component, round by round.
class Search {
 public:
  // The multipliers need not be feasible.
  Search(const Component& component, relax::Prices prices, Packing best)
      : component_(component), prices_(std::move(prices)), best_(std::move(best)) {}

  // Ascent on the arcs of least reduced cost, then what it proves of all.
  void ascend(int max_sweeps, const core::Deadline& deadline) {
    const std::size_t count =
        std::max(kActivePerIndex * component_.num_indices(), component_.num_arcs() / kActiveShare);
    const std::vector<ArcId> active = cheapest_arcs(prices_.reduced_costs(), count);
    relax::Ascent ascent(component_, active, prices_.u(), relax::kFastShare);
    ascent.climb(max_sweeps, kLeastMove * core::largest_cost(component_), deadline);
    ascent.tighten();
    prices_.set(ascent.u());
    prices_.repair();
    const double lower = prices_.bound();
    if (!r_.empty() && lower <= lower_) return;
    lower_ = lower;
    u_ = prices_.u();
    r_.assign(prices_.reduced_costs().begin(), prices_.reduced_costs().end());
  }

  const std::vector<double>& u() const { return u_; }
  double lower() const { return lower_; }
  const Packing& best() const { return best_; }
  bool is_wide() const { return best_.cost - lower_ > -kWideGap * best_.cost; }

  decompose::ExchangeFixing fix(const Precision& precision) const {
    const double tolerance =
        kToleranceShare * precision.margin /
        static_cast<double>(std::max<std::size_t>(1, component_.num_indices()));
    return decompose::fix_by_exchange(component_, u_, r_, best_, tolerance);
  }

  // Greedy by cost, and by reduced cost.
  void try_packings(std::span<const ArcId> arcs) {
    std::vector<double> key;
    for (const ArcId a : arcs) key.push_back(component_.costs[a]);
    offer(recovery::greedy(component_, arcs, key));
    follow_prices(arcs);
  }

  void follow_prices(std::span<const ArcId> arcs) {
    std::vector<double> key;
    for (const ArcId a : arcs)
      key.push_back(prices_.reduced_costs()[a] + recovery::kTieBreak * component_.costs[a]);
    offer(recovery::greedy(component_, arcs, key));
  }

  void follow_prices() {
    follow_prices(cheapest_arcs(prices_.reduced_costs(), kNearPerIndex * component_.num_indices()));
  }

 private:
  void offer(const Packing& packing) {
    if (best_.arcs.empty())
      best_ = packing;
    else if (packing.arcs != best_.arcs)
      best_ = recovery::combine(component_, best_, packing);
  }

  const Component& component_;
  relax::Prices prices_;   // of the last round
  std::vector<double> u_;  // those that prove most, and their reduced costs
  std::vector<double> r_;
  double lower_ = 0;  // sum u
  Packing best_;
};

// By arc of those listed: whether it is in a packing.
std::vector<char> membership(std::span<const ArcId> arcs, const Packing& packing) {
  std::vector<char> is_in;
  for (const ArcId a : arcs)
    is_in.push_back(std::binary_search(packing.arcs.begin(), packing.arcs.end(), a));
  return is_in;
}

// Keeps what a search of `from` leaves open, and settles the rest.
void narrow(HotStart& hot,
            const Component& from,
            const Search& search,
            const core::CostGrid& grid,
            core::Cutter& cutter) {
  core::extend_slots(from, search.u(), hot.live, hot.learned_u);
  const decompose::ExchangeFixing fixing = search.fix(precision_of(from, grid));
  for (const ArcId a : fixing.settled) {
    hot.settled.push_back(core::original_arc(from, a));
    hot.settled_cost += from.costs[a];
  }
  ++hot.yield.rounds;
  hot.yield.kept += fixing.settled.size();
  hot.yield.excluded += from.num_arcs() - fixing.open.size() - fixing.settled.size();
  Component open = cutter.cut(from, fixing.open);
  hot.open_u = core::restrict_slots(from, search.u(), open);
  hot.is_best = membership(fixing.open, search.best());
  hot.open = std::move(open);
}

Packing best_of_open(const HotStart& hot) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < hot.is_best.size(); ++a) {
    if (hot.is_best[a]) arcs.push_back(a);
  }
  return core::make_packing(hot.open, std::move(arcs));
}

// Makes multipliers exact where everything is settled: what its arcs and the indices left uncovered
// lose is not needed to exclude others (decompose/exchange_fixing.hpp).
void charge_settled(const HotStart& hot, std::vector<double>& u) {
  std::vector<char> is_settled(u.size(), 1);
  core::for_each_index(hot.open, [&](std::uint32_t, std::size_t k, Index i) {
    is_settled[hot.live.offset[k] + i] = 0;
  });
  for (const ArcId a : core::arcs_from_original(hot.live, hot.settled)) {
    double rest = core::reduced_cost(hot.live, u, a);
    core::for_each_slot(hot.live, a, [&](std::uint32_t slot) {
      const double raise = std::min(rest, -u[slot]);
      u[slot] += raise;
      rest -= raise;
      is_settled[slot] = 0;
    });
  }
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    if (is_settled[slot]) u[slot] = 0;
  }
}

}  // namespace

std::optional<HotStart> make_hot_start(const Problem& problem,
                                       const core::Shift& shift,
                                       const core::CostGrid& grid,
                                       const WarmStart& warm,
                                       const core::Deadline& deadline) {
  HotStart hot;
  hot.live = live_part(problem, shift, deadline);
  if (deadline.reached() || hot.live.num_arcs() == 0) return std::nullopt;
  hot.precision = precision_of(hot.live, grid);
  hot.yield.arcs = hot.live.num_arcs();
  std::vector<char> is_new;
  relax::Prices prices(hot.live, old_multipliers(hot.live, shift, warm, is_new));
  prices.tighten(is_new);
  Search search(hot.live, std::move(prices), {});
  if (deadline.reached()) return std::nullopt;
  search.ascend(kSweeps, deadline);
  if (deadline.reached()) return std::nullopt;
  search.follow_prices();
  if (search.is_wide())
    search.try_packings(continuations(hot.live, old_tuples(hot.live, warm), warm.arcs.size()));
  if (deadline.reached()) return std::nullopt;
  hot.u = search.u();
  hot.lower = search.lower();
  hot.learned_u = hot.u;
  core::Cutter cutter;
  narrow(hot, hot.live, search, grid, cutter);
  if (hot.open.num_arcs() > 0) {
    if (deadline.reached()) return std::nullopt;
    Search closer(hot.open, {hot.open, hot.open_u}, best_of_open(hot));
    closer.ascend(kMoreSweeps, deadline);
    closer.follow_prices();
    narrow(hot, hot.open, closer, grid, cutter);
  }
  std::sort(hot.settled.begin(), hot.settled.end());
  return hot;
}

HotPart cut_part(const HotStart& hot,
                 std::span<const ArcId> arcs,
                 core::Cutter& cutter,
                 const core::Deadline& deadline) {
  HotPart part{cutter.cut(hot.open, arcs, deadline), {}};
  if (deadline.reached()) return part;
  std::vector<ArcId> best;
  for (ArcId a = 0; a < arcs.size(); ++a) {
    if (hot.is_best[arcs[a]]) best.push_back(a);
  }
  part.hint = {core::restrict_slots(hot.open, hot.open_u, part.component),
               core::make_packing(part.component, std::move(best))};
  return part;
}

void learn(HotStart& hot, const Component& part, std::span<const double> u) {
  core::extend_slots(part, u, hot.open, hot.open_u);
}

void count(const HotStart& hot, Stats& stats) {
  stats.exchange = hot.yield;
  stats.arcs_after_shift += hot.yield.kept + hot.yield.excluded;
}

void add_multipliers(HotStart& hot, std::vector<std::vector<double>>& multipliers) {
  std::vector<double> u = hot.learned_u;
  core::extend_slots(hot.open, hot.open_u, hot.live, u);
  charge_settled(hot, u);
  relax::Prices learned(hot.live, std::move(u));
  learned.repair();
  const std::vector<double>& best = learned.bound() > hot.lower ? learned.u() : hot.u;
  core::for_each_index(hot.live, [&](std::uint32_t slot, std::size_t k, Index i) {
    multipliers[k][i - 1] += best[slot];
  });
}

}  // namespace nda::pipeline
