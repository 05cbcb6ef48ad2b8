#include "kbest/slack_ranker.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/component.hpp"
#include "core/slices.hpp"
#include "decompose/components.hpp"
#include "kbest/arc_sets.hpp"
#include "kbest/ranks.hpp"
#include "kbest/sums.hpp"
#include "solve/component_solver.hpp"
#include "solve/costs.hpp"

// Exact ranking by a threshold.  With the multipliers of the best solution every cost is a constant
// plus slack: reduced costs of the arcs used, prices of the indices left alone, all >= 0.
//
//   1. Solutions that differ from the best by one arc are all different, so the (k - 1)-th best of
//      them bounds rank k: it costs at most so much more than the best.
//   2. Arcs of larger reduced cost are in no solution of these ranks; those that cost no less than
//      leaving their indices alone, which the best can do without, may be.
//   3. What is left falls apart.  The best solution is best in every part, so nothing in a part
//      costs more than that `reach` above it, either: a budget for the ranking of the part.
//   4. The k best sums of one packing of each part are found lazily.
//
// Solutions multiply where differences combine, so the bound of 1 is far too high for large k.  The
// reach starts at the few neighbours whose combinations might be k, and grows until there are k.
// What is found within a reach is proven, whatever becomes of the next.
//
// Every part knows from which reach on it may have more than it has listed, so a larger reach
// searches only in parts where there may be something to find, and never stays below the least of
// these.  Parts are cut generously, since a part that gets another arc is a new one.
//
// Sums are begun anew after every search and those listed before are passed over: of equal ones
// either search may list others first, so only the arcs tell.
//
// A limit leaves nothing of a search that it stops.  So very long lists are made in passes
// (kbest/ranks.hpp).
//
// Source of 1 and 2: reduced-cost fixing, against the k-th value; of 4: Lawler (1972).

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr std::size_t kFirstPass = 10000;  // ranks that the first pass is for, or more
constexpr std::size_t kPassGrowth = 10;    // from pass to pass, at most
constexpr double kGrowth = 1.5;            // of the number of neighbours within reach
constexpr double kBlindGrowth = 2;         // of the reach, where neighbours say nothing
constexpr double kLeastGrowth = 1.25;      // beyond the reach from where on there may be more
constexpr std::size_t kSortedBetweenLooks = 4096;

// As many neighbours as have k combinations, if no two exclude each other, and as many again.
std::size_t first_within(std::size_t k) {
  return 2 * static_cast<std::size_t>(
                 std::ceil(std::log2(static_cast<double>(std::max<std::size_t>(k, 2)))));
}

bool is_dearer(const SlackView::Neighbour& a, const SlackView::Neighbour& b) {
  return std::tie(a.rise, a.arc, a.second) > std::tie(b.rise, b.arc, b.second);
}

}  // namespace

SlackRanker::SlackRanker(const Problem& problem, const Solution& solution)
    : problem_(problem), solution_(solution) {}

bool SlackRanker::list(std::size_t enough, std::size_t planned, const RankLimits& limits) {
  RankLimits left = limits;
  const std::int64_t before = nodes_;
  const auto lists = [&](std::size_t count) { return has_all_ || listed_.size() >= count; };
  if (lists(enough)) return true;
  if (!look(planned, limits.deadline)) return false;
  std::size_t pass = first_pass(std::max(kFirstPass, listed_.size() + 1), kPassGrowth, planned);
  while (!lists(enough)) {
    left.max_nodes = limits.max_nodes - (nodes_ - before);
    if (limits.deadline.reached() || !widen(next_reach(pass, limits.deadline), pass, left))
      return false;
    if (lists(pass)) pass = std::min(planned, kPassGrowth * pass);
  }
  return true;
}

// At the problem, once.
bool SlackRanker::look(std::size_t planned, const core::Deadline& deadline) {
  if (view_) return true;
  view_.emplace(problem_, solution_, deadline);
  if (!deadline.reached()) others_ = view_->neighbours(first_within(planned), deadline);
  if (deadline.reached()) {
    view_.reset();
    return false;
  }
  std::make_heap(others_.begin(), others_.end(), is_dearer);
  error_ =
      pipeline::precision_of(problem_.num_indices(), pipeline::largest_cost(problem_), {}).error;
  grid_ = core::find_grid(problem_, deadline).step;
  Combination best = kNothing;
  for (const ArcId a : view_->best()) best = combinations_.join(best, combinations_.single(a));
  append(best);
  number(listed_);
  return true;
}

// So many of them, as long as the deadline lets it.
void SlackRanker::sort_neighbours(std::size_t count, const core::Deadline& deadline) {
  while (neighbours_.size() < count && !others_.empty()) {
    if (neighbours_.size() % kSortedBetweenLooks == kSortedBetweenLooks - 1 && deadline.reached())
      break;
    std::pop_heap(others_.begin(), others_.end(), is_dearer);
    neighbours_.push_back(others_.back());
    others_.pop_back();
  }
}

// What the first neighbours cost more than the best; +inf where there are not so many.
double SlackRanker::reach_of(std::size_t within, const core::Deadline& deadline) {
  if (within == 0) return 0;
  if (within > num_neighbours()) return kInfinity;
  sort_neighbours(within, deadline);
  return std::max(0.0, neighbours_[std::min(within, neighbours_.size()) - 1].rise);
}

// The same again, where more was within it than was asked for.
double SlackRanker::next_reach(std::size_t planned, const core::Deadline& deadline) {
  if (is_cut_short_) return reach_;
  const auto more = static_cast<std::size_t>(kGrowth * static_cast<double>(within_)) + 1;
  within_ = std::min(std::max(first_within(planned), within_ > 0 ? more : 0), planned - 1);
  const double least = reached();
  double reach = reach_of(within_, deadline);
  if (reach == kInfinity && num_neighbours() > 0 && parts_.empty())
    reach = reach_of(num_neighbours(), deadline);
  if (reach == kInfinity || !(reach > reach_)) reach = kBlindGrowth * std::max(reach_, error_);
  return std::max(reach > least ? reach : kLeastGrowth * least, beyond(reach_, error_));
}

// The least reach within which there may be what is not listed.
double SlackRanker::reached() const {
  double least = next_arc_;
  for (const Part& part : parts_) least = std::min(least, part.reached());
  return least;
}

// Ranks all solutions within a reach, or the k best of them.
bool SlackRanker::widen(double reach, std::size_t k, const RankLimits& limits) {
  const double tolerance = beyond(view_->slack() + reach, error_) - (view_->slack() + reach);
  if (!split(reach + 2 * tolerance, k, limits.deadline)) return false;
  bnb::SlackLimits search;
  search.deadline = limits.deadline;
  const std::int64_t before = nodes_;
  for (Part& part : parts_) {
    search.max_nodes = limits.max_nodes - (nodes_ - before);
    if (!part.rank(reach + 2 * tolerance, k, search, combinations_, nodes_)) return false;
  }
  reach_ = reach;
  return add_sums(std::max(reach + tolerance, reached()), k, limits.deadline);
}

// Cuts out what is within reach, if it was not yet, and more than that.
bool SlackRanker::split(double reach, std::size_t k, const core::Deadline& deadline) {
  if (reach <= cut_reach_) return true;
  const double most = reach_of(k - 1, deadline);
  const double cut = most < kInfinity ? std::max(reach, most) : kBlindGrowth * reach;
  const double budget = view_->slack() + cut;
  std::vector<ArcId> near;
  double next = kInfinity;
  const bool is_whole = core::for_each_until(deadline, problem_.num_arcs(), [&](std::size_t a) {
    const double r = view_->reduced(static_cast<ArcId>(a));
    if (r <= budget) {
      near.push_back(static_cast<ArcId>(a));
    } else {
      next = std::min(next, r);
    }
  });
  if (!is_whole || !replace_parts(near, deadline)) return false;
  cut_reach_ = cut;
  next_arc_ = next == kInfinity ? next : std::max(cut, next - beyond(view_->slack(), error_));
  return true;
}

// By those of these arcs; those with the same arcs stay.
bool SlackRanker::replace_parts(const std::vector<ArcId>& near, const core::Deadline& deadline) {
  core::Cutter cutter;
  const core::Component whole = cutter.cut(problem_, view_->multipliers(), near, deadline);
  const decompose::Partition partition = decompose::partition(whole, deadline);
  std::map<ArcId, Part*> old;
  for (Part& part : parts_) old[part.arcs().front()] = &part;
  std::vector<Part> parts;
  std::vector<Part*> kept;
  for (std::size_t p = 0; p < partition.num_components(); ++p) {
    if (deadline.reached()) break;
    const std::vector<ArcId> arcs = core::at_positions(near, partition.component(p));
    const auto same = old.find(arcs.front());
    if (same != old.end() && std::ranges::equal(same->second->arcs(), arcs)) {
      kept.push_back(same->second);
      continue;
    }
    parts.emplace_back(cutter.cut(whole, partition.component(p), deadline), *view_, grid_);
  }
  if (deadline.reached()) return false;
  for (Part* part : kept) parts.push_back(std::move(*part));
  parts_ = std::move(parts);
  return true;
}

// Lists sums of the parts' packings up to a reach, the k least.
bool SlackRanker::add_sums(double reach, std::size_t k, const core::Deadline& deadline) {
  std::vector<const RankedList*> lists;
  for (const Part& part : parts_) lists.push_back(&part.list());
  is_cut_short_ = true;
  Sums sums(std::move(lists), combinations_);
  const std::size_t before = listed_.size();
  std::size_t count = 0;
  for (; count < k && !deadline.reached(); ++count) {
    const std::optional<Ranked> sum = sums.next();
    is_cut_short_ = sum && sum->slack <= reach;
    if (!is_cut_short_) break;
    append(sum->arcs);
  }
  // By cost, which rounds otherwise than slack.
  sort_by_cost(listed_, before);
  number(listed_);
  has_all_ = !is_cut_short_ && reached() == kInfinity;
  return !is_cut_short_ || count == k;
}

std::vector<ArcId> SlackRanker::arcs_of(Combination combination) const {
  std::vector<ArcId> arcs = combinations_.arcs(combination);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

bool SlackRanker::is_listed(const std::vector<ArcId>& arcs, std::size_t hash) const {
  const auto [first, last] = by_hash_.equal_range(hash);
  return std::any_of(first, last, [&](const auto& other) { return arcs_of(other.second) == arcs; });
}

// Unless it is listed.
void SlackRanker::append(Combination combination) {
  std::vector<ArcId> arcs = arcs_of(combination);
  const std::size_t hash = ArcsHash()(arcs);
  if (is_listed(arcs, hash)) return;
  by_hash_.emplace(hash, combination);
  listed_.push_back(view_->solution_of(std::move(arcs)));
  listed_.back().proven = solution_.solutions.front().proven;
}

std::vector<RankedSolution> SlackRanker::unlisted(std::size_t skipped,
                                                  std::size_t count,
                                                  const core::Deadline& deadline) {
  std::vector<RankedSolution> found;
  if (!look(count, deadline)) return found;
  std::size_t seen = 0;
  for (std::size_t n = 0; found.size() < count; ++n) {
    if (found.size() >= kFewNeighbours && deadline.reached()) break;
    sort_neighbours(n + 1, deadline);
    if (n == neighbours_.size()) break;
    std::vector<ArcId> arcs = view_->arcs_of(neighbours_[n]);
    std::sort(arcs.begin(), arcs.end());
    if (is_listed(arcs, ArcsHash()(arcs)) || seen++ < skipped) continue;
    found.push_back(view_->solution_of(std::move(arcs)));
  }
  sort_by_cost(found);
  return found;
}

}  // namespace nda::kbest
