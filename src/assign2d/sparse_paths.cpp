#include "assign2d/sparse_paths.hpp"

#include <algorithm>

#include "assign2d/offers.hpp"

// Shortest augmenting paths after Jonker & Volgenant, "A shortest augmenting path algorithm for
// dense and sparse linear assignment problems", Computing 38 (1987) 325-340.
//
// Given prices v of the other side, a member's best offer is min(outside, min c - v).  Two steps:
//
// Bids (their "augmenting row reduction"): a member takes its best partner and raises that
// partner's price until the second best offer is as good; whoever held the partner bids next.  This
// is an auction with epsilon = 0: it may stall, so it has a budget, but it settles most members at
// the price of a row each.
//
// Searches: Dijkstra on the reduced costs c - u - v >= 0 from each member left.  The path may end
// at a free partner, or at a member of the tree (the source included) that gives its partner up for
// its outside option.  Outside options therefore need no nodes of their own, and a search ends
// where the first of the two becomes cheapest.  Inside the tree of radius D, u grows and v shrinks
// by D - distance.
//
// Differences to the paper: outside options on both sides, and the two-sided use: after the rows
// the columns in want are served by the same code on the transpose, during which assigned rows stay
// assigned and unassigned rows keep u = outside, so that slackness of the rows survives.  The heap
// holds assigned partners nearer than the best end known, nothing else; most searches of a tracking
// problem never use it.

namespace nda::lap {
namespace {

// Bids per member in want; more of them stall on ties and small gains.
constexpr std::size_t kBidsPerMember = 8;

struct BidOutcome {
  std::uint32_t displaced;  // who has to look again, or kNone
  bool gain;                // the price moved, so that the displaced member sees another market
};

// One bid of the free member i.  Returns i itself where the market gives no answer.
template <class View>
BidOutcome bid_once(const Phase<View>& phase, std::uint32_t i) {
  const Offers best = best_offers(phase, i);
  if (best.first == kInfinity) return {i, false};
  phase.own.dual[i] = best.first;
  if (best.first_pair == kNone) return {kNone, false};
  std::uint32_t k = best.first_pair;
  const bool gain = best.first < best.second && best.second < kInfinity;
  if (!gain && !phase.other.is_free(phase.view.partner[k])) {
    if (best.second > best.first || best.second_pair == kNone) return {i, false};
    k = best.second_pair;
    if (!phase.other.is_free(phase.view.partner[k])) return {i, false};
  }
  const std::uint32_t j = phase.view.partner[k];
  if (gain) {
    phase.other.dual[j] -= best.second - best.first;
    phase.own.dual[i] = best.second;
  }
  const std::int32_t former = phase.other.mate[j];
  if (former != kUnassigned) phase.own.mate[former] = kUnassigned;
  phase.match(i, j, k);
  return {former == kUnassigned ? kNone : static_cast<std::uint32_t>(former), gain};
}

}  // namespace

void SparsePaths::resize(std::size_t n) {
  forget_search();
  heap_.resize(n);
  if (distance_.size() >= n) return;
  distance_.resize(n, kInfinity);
  from_.resize(n);
  from_pair_.resize(n);
  for (std::vector<std::uint32_t>* list : {&waiting_, &ready_, &reached_, &settled_}) {
    list->reserve(n);
  }
}

template <class View>
void SparsePaths::list_wanting(const Phase<View>& phase) {
  waiting_.clear();
  for (std::uint32_t i = 0; i < phase.own.size(); ++i) {
    if (phase.own.in_want(i)) waiting_.push_back(i);
  }
}

template <class View>
std::size_t SparsePaths::bid(const Phase<View>& phase) {
  list_wanting(phase);
  std::size_t unserved = 0;
  std::size_t budget = kBidsPerMember * waiting_.size();
  for (std::uint32_t i : waiting_) {
    bool gain = true;
    while (i != kNone && gain && budget > 0) {
      --budget;
      stop_check_.spend(phase.view.start[i + 1] - phase.view.start[i]);
      const BidOutcome outcome = bid_once(phase, i);
      i = outcome.displaced;
      gain = outcome.gain;
    }
    if (i != kNone) ++unserved;
  }
  return unserved;
}

template <class View>
bool SparsePaths::search(const Phase<View>& phase, std::vector<std::uint32_t>& hall) {
  list_wanting(phase);
  for (const std::uint32_t source : waiting_) {
    const End end = find_path(phase, source);
    if (end.distance == kInfinity) {
      hall.push_back(source);
      for (const std::uint32_t j : settled_) hall.push_back(phase.other.mate[j]);
      std::sort(hall.begin(), hall.end());
      return false;
    }
    update_duals(phase, source, end.distance);
    flip(phase, source, end);
  }
  return true;
}

template <class View>
SparsePaths::End SparsePaths::find_path(const Phase<View>& phase, std::uint32_t source) {
  forget_search();
  End end{kInfinity, true, source};
  scan(phase, source, 0, end);
  while (true) {
    std::uint32_t j = kNone;
    if (!ready_.empty()) {
      j = ready_.back();
      ready_.pop_back();
    } else if (!heap_.empty() && heap_.top_key() < end.distance) {
      j = heap_.pop();
    }
    if (j == kNone || !(distance_[j] < end.distance)) return end;
    settled_.push_back(j);
    scan(phase, static_cast<std::uint32_t>(phase.other.mate[j]), distance_[j], end);
  }
}

template <class View>
void SparsePaths::scan(const Phase<View>& phase, std::uint32_t i, double distance, End& end) {
  const View& view = phase.view;
  stop_check_.spend(view.start[i + 1] - view.start[i]);
  const double dual = phase.own.dual[i];
  const double fallback = distance + std::max(0.0, phase.own.outside[i] - dual);
  if (fallback < end.distance) end = {fallback, true, i};
  for (std::uint32_t k = view.start[i]; k < view.start[i + 1]; ++k) {
    const std::uint32_t j = view.partner[k];
    const double reduced = std::max(0.0, view.cost(k) - dual - phase.other.dual[j]);
    const double reach = distance + reduced;
    if (!(reach < end.distance) || !(reach < distance_[j])) continue;
    if (distance_[j] == kInfinity) reached_.push_back(j);
    distance_[j] = reach;
    from_[j] = i;
    from_pair_[j] = k;
    if (phase.other.is_free(j)) {
      end = {reach, false, j};
    } else if (reach == distance && !heap_.contains(j)) {
      ready_.push_back(j);
    } else {
      heap_.push_or_decrease(j, reach);
    }
  }
}

template <class View>
void SparsePaths::update_duals(const Phase<View>& phase,
                               std::uint32_t source,
                               double length) const {
  phase.own.dual[source] += length;
  for (const std::uint32_t j : settled_) {
    const double change = length - distance_[j];
    phase.other.dual[j] -= change;
    phase.own.dual[phase.other.mate[j]] += change;
  }
}

template <class View>
void SparsePaths::flip(const Phase<View>& phase, std::uint32_t source, const End& end) const {
  std::uint32_t j = end.member;
  if (end.outside) {
    const std::int32_t freed = phase.own.mate[end.member];
    phase.own.dual[end.member] = phase.own.outside[end.member];
    phase.own.mate[end.member] = kUnassigned;
    if (end.member == source) return;
    j = static_cast<std::uint32_t>(freed);
  }
  for (std::uint32_t i = kNone; i != source;) {
    i = from_[j];
    const std::int32_t next = phase.own.mate[i];
    phase.match(i, j, from_pair_[j]);
    j = static_cast<std::uint32_t>(next);
  }
}

void SparsePaths::forget_search() {
  for (const std::uint32_t j : reached_) distance_[j] = kInfinity;
  reached_.clear();
  settled_.clear();
  ready_.clear();
  heap_.clear();
}

template std::size_t SparsePaths::bid(const Phase<RowView>&);
template std::size_t SparsePaths::bid(const Phase<ColumnView>&);
template bool SparsePaths::search(const Phase<RowView>&, std::vector<std::uint32_t>&);
template bool SparsePaths::search(const Phase<ColumnView>&, std::vector<std::uint32_t>&);

}  // namespace nda::lap
