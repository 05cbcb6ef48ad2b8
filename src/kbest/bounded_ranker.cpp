#include "kbest/bounded_ranker.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bounded/branch_and_bound.hpp"
#include "bounded/parts.hpp"
#include "bounded/split.hpp"
#include "core/lists.hpp"
#include "kbest/ranks.hpp"
#include "kbest/sums.hpp"
#include "solve/bounded_part.hpp"
#include "solve/uses.hpp"

// By a threshold, as without bounds (kbest/slack_ranker.cpp): k - 1 neighbours of the best solution
// say how much more the k-th costs at most, the reach, and arcs whose reduced cost exceeds that and
// the gap of the multipliers are in no solution of these ranks.  What is left falls apart, and in
// each part the best solution is best, so that none of its k best that matter is beyond the reach.
//
// Within a part the search for the best one goes on: its cutoff is the k-th best cost, and a branch
// ends where reduced costs leave one choice.  Where a limit stops it, what it bounds from below
// still proves the ranks that cost no more.
//
// That bound is of no use as long as any branch is open high up in the tree.  So a long list is
// made in passes, each for some times as many ranks as the one before: a limit leaves what the last
// whole pass proved, and all of them take little more than the last.

namespace nda::kbest {

using bounded::BoundedComponent;
using bounded::Choice;
using core::ArcId;

namespace {

constexpr std::size_t kFirstPass = 10;  // ranks that the first pass is for, or more
constexpr std::size_t kPassGrowth = 4;  // from pass to pass, at most
// Sums, and neighbours where a search in a part starts, that are made whatever the clock says.
constexpr std::size_t kFewSums = 100;

// The arcs that no bound of 0 forbids.
std::vector<ArcId> usable_arcs(const Problem& problem) {
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < problem.num_arcs(); ++a) {
    bool usable = true;
    for (int k = 0; k < problem.num_dimensions() && usable; ++k) {
      const Index i = problem.indices(k)[a];
      usable = i == 0 || problem.use_bounds(k, i).hi > 0;
    }
    if (usable) arcs.push_back(a);
  }
  return arcs;
}

}  // namespace

BoundedRanker::BoundedRanker(const Problem& problem, const Solution& solution)
    : problem_(problem), solution_(solution) {}

bool BoundedRanker::list(std::size_t enough, std::size_t planned, const RankLimits& limits) {
  const auto is_done = [&] { return has_all_ || listed_.size() >= enough; };
  if (is_done()) return true;
  if (!look(limits.deadline)) return false;
  RankLimits left = limits;
  const std::int64_t before = nodes_;
  std::size_t count = first_pass(std::max(kFirstPass, listed_.size() + 1), kPassGrowth, planned);
  while (!is_done()) {
    if (!pass(count, left) || count == planned) break;
    left.max_nodes = limits.max_nodes - (nodes_ - before);
    count = std::min(planned, kPassGrowth * count);
  }
  return is_done();
}

// Lists so many, or what the limits let it prove of them; then it returns false.
bool BoundedRanker::pass(std::size_t k, const RankLimits& limits) {
  const bool is_bounded = k - 2 < neighbours_.size();
  const double reach = is_bounded ? std::max(0.0, neighbours_[k - 2].rise) : kInfinity;
  core::Cutter cutter;
  const BoundedComponent near = bounded::cut_arcs(whole_, arcs_within(reach), cutter);
  std::vector<BoundedComponent> cut = bounded::cut_parts(near, limits.deadline);
  std::size_t seen = 0;
  std::vector<std::size_t> part_of(whole_.num_arcs(), cut.size());
  for (std::size_t p = 0; p < cut.size(); ++p) {
    std::vector<ArcId>& arcs = cut[p].graph.arc_origin;
    arcs = core::at_positions(near.graph.arc_origin, arcs);
    for (const ArcId a : arcs) part_of[a] = p;
    seen += arcs.size();
  }
  if (seen < near.num_arcs()) return false;
  const core::Lists<std::size_t> neighbours(cut.size() + 1, [&](auto&& visit) {
    for (std::size_t n = 0; n < neighbours_.size() && n + 1 < k; ++n)
      visit(part_of[neighbours_[n].changed.front()], n);
  });
  RankLimits left = limits;
  const std::int64_t before = nodes_;
  Combinations combinations;
  std::vector<PartList> parts;
  for (std::size_t p = 0; p < cut.size(); ++p) {
    left.max_nodes = std::max<std::int64_t>(0, limits.max_nodes - (nodes_ - before));
    parts.push_back(rank(std::move(cut[p]), neighbours[p], reach, k, left, combinations));
  }
  return add_sums(parts, k, limits.deadline, combinations) &&
         std::all_of(
             parts.begin(), parts.end(), [](const PartList& part) { return part.is_complete; });
}

// At the problem, once; the best solution is listed.
bool BoundedRanker::look(const core::Deadline& deadline) {
  if (has_looked_) return true;
  if (deadline.reached()) return false;
  const core::CostGrid grid = core::find_grid(problem_, deadline);
  if (deadline.reached()) return false;
  whole_ = bounded::whole_component(problem_, usable_arcs(problem_));
  if (deadline.reached()) return false;
  best_.clear();
  std::vector<ArcId> originals;
  for (const std::vector<Index>& tuple : solution_.solutions.front().arcs)
    originals.push_back(static_cast<ArcId>(*problem_.find(tuple)));
  std::sort(originals.begin(), originals.end());
  best_ = core::positions_in(whole_.graph.arc_origin, originals);
  neighbours_ = bounded_neighbours(whole_, best_, deadline);
  if (deadline.reached()) return false;
  const pipeline::Precision precision = pipeline::precision_of_part(whole_, grid);
  margin_ = precision.margin;
  error_ = precision.error;
  known_.insert(best_);
  listed_.push_back(solution_of(best_));
  listed_.back().proven = solution_.solutions.front().proven;
  has_looked_ = true;
  return true;
}

// Those of the whole that a solution may use which costs at most so much more than the best.
std::vector<ArcId> BoundedRanker::arcs_within(double reach) const {
  std::vector<double> u(whole_.rows.size(), 0.0);
  core::for_each_index(whole_.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
    u[slot] = solution_.multipliers[k][i - 1];
  });
  const double slack = solution_.cost - solution_.stats.certificate_bound + reach;
  const double most = slack + 2 * margin_ + 0x1p-40 * (std::abs(solution_.cost) + slack);
  std::vector<ArcId> arcs;
  for (ArcId a = 0; a < whole_.num_arcs(); ++a) {
    if (!(core::reduced_cost(whole_.graph, u, a) > most)) arcs.push_back(a);
  }
  return arcs;
}

// The origins of the part's arcs are those of the whole.
BoundedRanker::PartList BoundedRanker::rank(BoundedComponent part,
                                            std::span<const std::size_t> neighbours,
                                            double reach,
                                            std::size_t k,
                                            const RankLimits& limits,
                                            Combinations& combinations) {
  const std::vector<ArcId> arcs = part.graph.arc_origin;
  const Choice best = make_choice(part, core::positions_in(arcs, best_));
  const auto ranked = [&](const Choice& choice) {
    Combination combination = kNothing;
    for (const ArcId a : choice.arcs)
      combination = combinations.join(combination, combinations.single(arcs[a]));
    return Ranked{choice.cost - best.cost, combination};
  };
  if (limits.deadline.reached()) return {{ranked(best)}, 0, false};
  std::vector<Choice> starts = {best};
  for (const std::size_t n : neighbours) {
    if (starts.size() > kFewSums && limits.deadline.reached()) break;
    starts.push_back(make_choice(part, core::positions_in(arcs, arcs_of(neighbours_[n], best_))));
  }
  bounded::Wanted wanted{k, kInfinity, true};
  if (reach < kInfinity) {
    bounded::set_penalties_above(part, best.cost + reach);
    wanted.below = best.cost + reach + 4 * margin_;
  }
  const bounded::SearchLimits search{margin_, 0, limits.max_nodes, limits.deadline};
  const std::vector<double> zero(part.rows.size(), 0.0);
  const bounded::SearchResult found = list_best(part, starts, zero, wanted, search);
  nodes_ += found.nodes;
  PartList result;
  for (const Choice& choice : found.choices) result.list.push_back(ranked(choice));
  result.is_complete = found.end == bounded::SearchEnd::kComplete;
  if (!result.is_complete) {
    result.reached = found.lower - best.cost;
  } else {
    result.reached = result.list.size() == k ? result.list.back().slack : wanted.below - best.cost;
  }
  return result;
}

// Lists the k least sums, as far as the parts prove them; false at the deadline.
bool BoundedRanker::add_sums(const std::vector<PartList>& parts,
                             std::size_t k,
                             const core::Deadline& deadline,
                             Combinations& combinations) {
  std::vector<const RankedList*> lists;
  double reached = kInfinity;
  for (const PartList& part : parts) {
    lists.push_back(&part.list);
    reached = std::min(reached, part.reached);
  }
  Sums sums(std::move(lists), combinations);
  spare_.clear();
  const std::size_t before = listed_.size();
  std::optional<Ranked> sum;
  std::size_t count = 0;
  bool is_whole = true;
  for (; count < k && (sum = sums.next()); ++count) {
    if (count >= kFewSums && deadline.reached()) {
      is_whole = false;
      break;
    }
    std::vector<ArcId> arcs = combinations.arcs(sum->arcs);
    std::sort(arcs.begin(), arcs.end());
    if (known_.count(arcs) > 0) continue;
    if (sum->slack > reached + error_) {
      spare_.push_back(std::move(arcs));
      continue;
    }
    listed_.push_back(solution_of(arcs));
    listed_.back().proven = solution_.solutions.front().proven;
    known_.insert(std::move(arcs));
  }
  sort_by_cost(listed_, before);
  number(listed_);
  has_all_ = is_whole && reached == kInfinity && count < k;
  return is_whole;
}

RankedSolution BoundedRanker::solution_of(std::span<const ArcId> arcs) const {
  return *pipeline::solution_of_uses(
      problem_, core::at_positions(whole_.graph.arc_origin, {arcs.begin(), arcs.end()}));
}

std::vector<RankedSolution> BoundedRanker::unlisted(std::size_t skipped,
                                                    std::size_t count,
                                                    const core::Deadline& deadline) {
  std::vector<RankedSolution> found;
  if (!look(deadline)) return found;
  ArcSets seen;
  const auto add = [&](std::vector<ArcId> arcs) {
    if (found.size() >= skipped + kFewNeighbours && deadline.reached()) return false;
    if (known_.count(arcs) > 0) return true;
    const auto [place, is_new] = seen.insert(std::move(arcs));
    if (is_new) found.push_back(solution_of(*place));
    return true;
  };
  std::size_t n = 0;
  while (n < spare_.size() && add(spare_[n])) ++n;
  const std::size_t last = std::min(neighbours_.size(), skipped + count + listed_.size());
  n = 0;
  while (n < last && add(arcs_of(neighbours_[n], best_))) ++n;
  sort_by_cost(found);
  found.erase(found.begin(),
              found.begin() + static_cast<std::ptrdiff_t>(std::min(skipped, found.size())));
  if (found.size() > count) found.resize(count);
  return found;
}

}  // namespace nda::kbest
