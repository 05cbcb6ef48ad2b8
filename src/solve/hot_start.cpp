#include "solve/hot_start.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/slices.hpp"
#include "recovery/greedy.hpp"
#include "relax/ascent.hpp"

// A window moved by one scan keeps its picture but hardly a cost: births and trailing misses shift
// them all, and what was charged to the scan that left must be charged elsewhere.  So nothing of
// the last solution is true any more, but all of it nearly is.  The old multipliers, with those of
// the new scan set to what its arcs pay, leave most arcs with a reduced cost that no small change
// will bring down.  The others, a few per index, are the active arcs: coordinate ascent on them
// costs next to nothing, and one pass over the rest tells whether that was fair.  The old arcs say
// who belongs together; the best continuation of each is a packing.  Its distance from the bound
// excludes nearly everything before anything is split, sorted or copied, which is what takes the
// time where problems are small.

namespace nda::pipeline {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

// Arcs of least reduced cost: those that coordinate ascent sees, and the packings are made of.
constexpr std::size_t kActivePerIndex = 4;
constexpr std::size_t kNearPerIndex = 1;
constexpr std::size_t kSample = 500;
constexpr int kSweeps = 5;
// A part is cut again where its own gap leaves less than this share of its arcs.
constexpr double kWorthCutting = 0.7;

// The arcs that improve on their singletons.
Component live_part(const Problem& problem,
                    const core::Shift& shift,
                    const core::Deadline& deadline) {
  std::vector<ArcId> live;
  const auto note = [&](std::size_t a) {
    if (core::shifted_cost(problem, shift, a) < 0) live.push_back(static_cast<ArcId>(a));
  };
  if (!core::for_each_until(deadline, problem.num_arcs(), note)) return {};
  return core::Cutter().cut(problem, shift, live, deadline);
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
  for (ArcId a = 0; a < reduced.size(); ++a) {
    if (reduced[a] <= bound) cheapest.push_back(a);
  }
  return cheapest;
}

// By slot of the problem: 1 + the number of the old tuple that it belongs to, 0 = none or several.
std::vector<std::uint32_t> old_tuples(const Problem& problem,
                                      const core::Shift& shift,
                                      const WarmStart& warm) {
  std::vector<std::uint32_t> tuple_of(problem.num_indices() + shift.offset.size(), 0);
  const auto dimensions = static_cast<std::size_t>(problem.num_dimensions());
  for (std::uint32_t t = 0; t < warm.arcs.size(); ++t) {
    const std::vector<Index>& tuple = warm.arcs[t];
    for (std::size_t k = 0; k < std::min(dimensions, tuple.size()); ++k) {
      if (tuple[k] > 0 && tuple[k] <= problem.size(static_cast<int>(k)))
        tuple_of[shift.offset[k] + tuple[k]] = t + 1;
    }
  }
  return tuple_of;
}

// Greedy by cost among the arcs that mix no two old tuples, then among the others.
Packing continue_old(const Component& near,
                     const core::Shift& shift,
                     const std::vector<std::uint32_t>& tuple_of) {
  std::vector<std::uint32_t> tuple(near.num_slots(), 0);
  core::for_each_index(near, [&](std::uint32_t slot, std::size_t k, Index i) {
    tuple[slot] = tuple_of[shift.offset[k] + i];
  });
  const double least = *std::min_element(near.costs.begin(), near.costs.end());
  std::vector<double> key = near.costs;
  for (ArcId a = 0; a < near.num_arcs(); ++a) {
    std::uint32_t owner = 0;
    bool mixes = false;
    core::for_each_slot(near, a, [&](std::uint32_t slot) {
      mixes = mixes || (owner != 0 && tuple[slot] != 0 && tuple[slot] != owner);
      owner = std::max(owner, tuple[slot]);
    });
    if (mixes) key[a] -= least;
  }
  return recovery::greedy(near, key);
}

// A packing of arcs of `live`, among those of least reduced cost.
Packing find_packing(const HotStart& hot,
                     std::span<const double> reduced,
                     const core::Shift& shift,
                     const std::vector<std::uint32_t>& tuple_of) {
  const std::vector<ArcId> arcs = cheapest_arcs(reduced, kNearPerIndex * hot.live.num_indices());
  const Component near = core::Cutter().cut(hot.live, arcs);
  Packing old = continue_old(near, shift, tuple_of);
  Packing guided = recovery::dual_greedy(near, core::restrict_slots(hot.live, hot.u, near));
  Packing& best = guided.cost < old.cost ? guided : old;
  best.arcs = core::at_positions(arcs, best.arcs);
  return std::move(best);
}

HotPart cut_whole_part(const HotStart& hot,
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
  std::vector<char> is_new;
  relax::Ascent first(hot.live, old_multipliers(hot.live, shift, warm, is_new));
  first.tighten(is_new);
  const std::vector<ArcId> near =
      cheapest_arcs(first.reduced_costs(), kActivePerIndex * hot.live.num_indices());
  core::Cutter cutter;
  const Component active = cutter.cut(hot.live, near, deadline);
  if (deadline.reached()) return std::nullopt;
  relax::Ascent ascent(active, core::restrict_slots(hot.live, first.u(), active));
  for (int n = 0; n < kSweeps; ++n) ascent.sweep();
  ascent.tighten();
  hot.u = first.u();
  core::extend_slots(active, ascent.u(), hot.live, hot.u);
  relax::Ascent whole(hot.live, std::move(hot.u));
  whole.repair();
  hot.u = whole.u();
  hot.lower = whole.bound();
  const Packing best =
      find_packing(hot, whole.reduced_costs(), shift, old_tuples(problem, shift, warm));
  const double cutoff = best.cost - hot.precision.margin;
  std::vector<char> is_best(hot.live.num_arcs(), 0);
  for (const ArcId a : best.arcs) is_best[a] = 1;
  std::vector<ArcId> open;
  for (ArcId a = 0; a < is_best.size(); ++a) {
    if (is_best[a] || hot.lower + whole.reduced_costs()[a] < cutoff) open.push_back(a);
  }
  hot.open = cutter.cut(hot.live, open, deadline);
  if (deadline.reached()) return std::nullopt;
  hot.open_u = core::restrict_slots(hot.live, hot.u, hot.open);
  for (const ArcId a : open) {
    hot.is_best.push_back(is_best[a]);
    hot.open_r.push_back(whole.reduced_costs()[a]);
  }
  return hot;
}

HotPart cut_part(const HotStart& hot,
                 const core::CostGrid& grid,
                 std::span<const ArcId> arcs,
                 core::Cutter& cutter,
                 const core::Deadline& deadline) {
  HotPart part = cut_whole_part(hot, arcs, cutter, deadline);
  if (deadline.reached()) return part;
  const Hint& hint = part.hint;
  const double lower = std::accumulate(hint.u.begin(), hint.u.end(), 0.0);
  const double gap = hint.best.cost - precision_of(part.component, grid).margin - lower;
  std::vector<ArcId> near;
  for (const ArcId a : arcs) {
    if (hot.is_best[a] || hot.open_r[a] < gap) near.push_back(a);
  }
  const double share = static_cast<double>(near.size()) / static_cast<double>(arcs.size());
  return share < kWorthCutting ? cut_whole_part(hot, near, cutter, deadline) : std::move(part);
}

void learn(HotStart& hot, const Component& part, std::span<const double> u) {
  core::extend_slots(part, u, hot.open, hot.open_u);
}

void add_multipliers(HotStart& hot, std::vector<std::vector<double>>& multipliers) {
  std::vector<double> u = hot.u;
  core::extend_slots(hot.open, hot.open_u, hot.live, u);
  relax::Ascent learned(hot.live, std::move(u));
  learned.repair();
  const std::vector<double>& best = learned.bound() > hot.lower ? learned.u() : hot.u;
  core::for_each_index(hot.live, [&](std::uint32_t slot, std::size_t k, Index i) {
    multipliers[k][i - 1] += best[slot];
  });
}

}  // namespace nda::pipeline
