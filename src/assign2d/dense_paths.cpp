#include "assign2d/dense_paths.hpp"

#include <algorithm>

#include "assign2d/dense_kernels.hpp"

// The algorithm of sparse_paths.cpp on a full matrix (Jonker & Volgenant 1987, their dense form).
// Dijkstra without a heap: every step relaxes a whole line and returns the least distance left, and
// block minima tell where it is.  All members at that distance are settled together, so ties cost
// one look; if one of them is free, the search is over.
//
// A settled member gets price -inf and distance +inf in the working arrays, so that no later line
// can reach it and the loop over a line needs no test.

namespace nda::lap {
namespace {

constexpr std::size_t kBidsPerMember = 8;

struct BidOutcome {
  std::uint32_t displaced;  // who has to look again, or kNone
  bool gain;                // the price moved
};

void match(const DensePhase& phase, std::uint32_t i, std::uint32_t j) {
  phase.own.mate[i] = static_cast<std::int32_t>(j);
  phase.other.mate[j] = static_cast<std::int32_t>(i);
}

// A free member of other, after `at`, whose offer is as good; kNone if there is none.
std::uint32_t free_equal(const DensePhase& phase, const double* c, double offer, std::uint32_t at) {
  for (std::uint32_t j = at + 1; j < phase.other.size(); ++j) {
    if (c[j] - phase.other.dual[j] == offer && phase.other.is_free(j)) return j;
  }
  return kNone;
}

// One bid of the free member i.  Returns i itself where the market gives no answer.
BidOutcome bid_once(const DensePhase& phase, std::uint32_t i) {
  const double* c = phase.view.line(i);
  const LineOffers best = line_offers(c, phase.other.dual.data(), phase.other.size());
  const double outside = phase.own.outside[i];
  if (best.first >= outside) {
    if (outside == kInfinity) return {i, false};
    phase.own.dual[i] = outside;
    return {kNone, false};
  }
  const double second = std::min(best.second, outside);
  const bool gain = best.first < second && second < kInfinity;
  phase.own.dual[i] = best.first;
  std::uint32_t j = best.at;
  if (!gain && !phase.other.is_free(j)) {
    if (second > best.first) return {i, false};
    j = free_equal(phase, c, best.first, j);
    if (j == kNone) return {i, false};
  }
  if (gain) {
    phase.other.dual[j] -= second - best.first;
    phase.own.dual[i] = second;
  }
  const std::int32_t former = phase.other.mate[j];
  if (former != kUnassigned) phase.own.mate[former] = kUnassigned;
  match(phase, i, j);
  return {former == kUnassigned ? kNone : static_cast<std::uint32_t>(former), gain};
}

}  // namespace

void DensePaths::resize(std::size_t n) {
  waiting_.reserve(n);
  settled_.reserve(n);
  settled_at_.reserve(n);
  price_.reserve(n);
  distance_.reserve(n);
  if (from_.size() < n) from_.resize(n);
  if (block_least_.size() < num_blocks(n)) block_least_.resize(num_blocks(n));
}

void DensePaths::list_wanting(const DensePhase& phase) {
  waiting_.clear();
  for (std::uint32_t i = 0; i < phase.own.size(); ++i) {
    if (phase.own.in_want(i)) waiting_.push_back(i);
  }
}

bool DensePaths::bid(const DensePhase& phase) {
  list_wanting(phase);
  bool all_served = true;
  std::size_t budget = kBidsPerMember * waiting_.size();
  for (std::uint32_t i : waiting_) {
    bool gain = true;
    while (i != kNone && gain && budget > 0) {
      --budget;
      stop_check_.spend(phase.other.size());
      const BidOutcome outcome = bid_once(phase, i);
      i = outcome.displaced;
      gain = outcome.gain;
    }
    all_served = all_served && i == kNone;
  }
  return all_served;
}

bool DensePaths::search(const DensePhase& phase, std::vector<std::uint32_t>& hall) {
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

DensePaths::End DensePaths::find_path(const DensePhase& phase, std::uint32_t source) {
  price_.assign(phase.other.dual.begin(), phase.other.dual.end());
  distance_.assign(phase.other.size(), kInfinity);
  settled_.clear();
  settled_at_.clear();
  End end{kInfinity, true, source};
  double nearest = scan(phase, source, 0, end);
  for (std::size_t next = 0;; ++next) {
    if (next == settled_.size() || nearest <= settled_at_.back()) {
      if (!(nearest < end.distance)) return end;
      settle_nearest(phase, nearest, end);
      if (!end.outside) return end;
    }
    const std::uint32_t i = static_cast<std::uint32_t>(phase.other.mate[settled_[next]]);
    nearest = scan(phase, i, settled_at_[next], end);
  }
}

// Relaxes the line of i; returns the least distance left.
double DensePaths::scan(const DensePhase& phase, std::uint32_t i, double distance, End& end) {
  stop_check_.spend(phase.other.size());
  const double dual = phase.own.dual[i];
  const double fallback = distance + std::max(0.0, phase.own.outside[i] - dual);
  if (fallback < end.distance) end = {fallback, true, i};
  return relax_line(phase.view.line(i),
                    price_.data(),
                    distance - dual,
                    i,
                    phase.other.size(),
                    distance_.data(),
                    from_.data(),
                    block_least_.data());
}

// Settles all members at `distance`, the least there is; the first free one among them is the end.
void DensePaths::settle_nearest(const DensePhase& phase, double distance, End& end) {
  const std::uint32_t n = phase.other.size();
  for (std::uint32_t begin = 0; begin < n; begin += kBlock) {
    if (block_least_[begin / kBlock] != distance) continue;
    for (std::uint32_t j = begin; j < std::min(begin + kBlock, n); ++j) {
      if (distance_[j] != distance) continue;
      if (phase.other.is_free(j)) {
        end = {distance, false, j};
        return;
      }
      settled_.push_back(j);
      settled_at_.push_back(distance);
      distance_[j] = kInfinity;
      price_[j] = -kInfinity;
    }
  }
}

void DensePaths::update_duals(const DensePhase& phase, std::uint32_t source, double length) const {
  phase.own.dual[source] += length;
  for (std::size_t n = 0; n < settled_.size(); ++n) {
    const std::uint32_t j = settled_[n];
    const double change = std::max(0.0, length - settled_at_[n]);
    phase.other.dual[j] -= change;
    phase.own.dual[phase.other.mate[j]] += change;
  }
}

void DensePaths::flip(const DensePhase& phase, std::uint32_t source, const End& end) const {
  std::uint32_t j = end.member;
  if (end.outside) {
    const std::int32_t freed = phase.own.mate[end.member];
    phase.own.dual[end.member] = phase.own.outside[end.member];
    phase.own.mate[end.member] = kUnassigned;
    if (end.member == source) return;
    j = static_cast<std::uint32_t>(freed);
  }
  for (std::uint32_t i = kNone; i != source;) {
    i = static_cast<std::uint32_t>(from_[j]);
    const std::int32_t next = phase.own.mate[i];
    match(phase, i, j);
    j = static_cast<std::uint32_t>(next);
  }
}

}  // namespace nda::lap
