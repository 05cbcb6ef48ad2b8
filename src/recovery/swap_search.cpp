#include "recovery/swap_search.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "nda/types.hpp"

// Where the linear relaxation is far off, slack is no guide, and a neighbourhood that can be
// searched exactly is small.  But there steps cost little: the gain of every arc is kept up to
// date, a step changes those of the arcs that exclude the ones that came or left, and the best of a
// thousand gains is found at once.
//
// Wu, Hao & Glover choose among adding, swapping one for one and dropping.  Here any number may
// leave for one that comes, since arcs of many indices seldom exclude but one; dropping is what is
// left when every arrival loses more.  And they start at random, where most starts here keep the
// greater part of the best packing found before (iterated tabu search): what good packings have in
// common need not be found again.  That finds in a second what random starts find in ten.  Packings
// found elsewhere are not started from: where those end, this search is to come another way.

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr std::uint64_t kTenure = 7;            // Wu, Hao & Glover 2012
constexpr std::uint64_t kMembersPerTenure = 2;  // a longer one at random, where more are in
constexpr std::uint64_t kPatience = 4000;       // steps without a better packing
constexpr std::size_t kStartsPerRandom = 4;
constexpr double kKept = 0.6;  // of the members of the best packing found, in the other starts
constexpr double kBetter = 1e-9;
constexpr double kWorkPerLook = 0.1;         // at a gain
constexpr std::uint64_t kStepsPerLook = 64;  // at the clock

constexpr std::size_t kBlock = GainPacking::kBlock;

// Halving is a maximum that compilers know to vectorise.
double most_of(const double* gain, const double* closed) {
  std::array<double, kBlock> open;
  for (std::size_t n = 0; n < kBlock; ++n) open[n] = gain[n] + closed[n];
  for (std::size_t half = kBlock / 2; half > 0; half /= 2) {
    for (std::size_t n = 0; n < half; ++n)
      open[n] = open[n + half] > open[n] ? open[n + half] : open[n];
  }
  return open[0];
}

}  // namespace

double SwapSearch::run(const Limits& limits,
                       core::Random& random,
                       const std::function<void(std::vector<std::uint32_t>)>& found) {
  for (std::size_t n = 0; n < limits.max_starts && rivals_.num_arcs() > 0 && !stopped(limits);
       ++n) {
    start(random);
    std::uint64_t patient_until = kPatience;
    while (time_ < patient_until && !stopped(limits) && step(random)) {
      if (packing_.total() <= best_total_ * (1 + kBetter)) continue;
      best_total_ = packing_.total();
      best_members_ = packing_.members();
      patient_until = time_ + kPatience;
    }
    if (best_total_ > elite_total_) {
      elite_ = best_members_;
      elite_total_ = best_total_;
    }
    found(rivals_.arcs_of_problem(best_members_));
  }
  return std::exchange(work_, 0.0);
}

bool SwapSearch::stopped(const Limits& limits) const {
  return work_ >= limits.max_work || (time_ % kStepsPerLook == 0 && limits.deadline.reached());
}

// A packing to which nothing can be added: at random, or after a part of the best one found.
void SwapSearch::start(core::Random& random) {
  time_ = 0;
  packing_.clear();
  block_most_.resize(packing_.gains().size() / kBlock);
  closed_.assign(packing_.gains().size(), 0.0);
  tabu_.clear();
  tabu_until_.assign(rivals_.num_arcs(), 0);
  if (num_starts_++ % kStartsPerRandom != 0) {
    for (const std::uint32_t n : elite_) {
      if (random.uniform() < kKept) packing_.insert(n);
    }
  }
  std::vector<std::uint32_t> order(rivals_.num_arcs());
  std::iota(order.begin(), order.end(), 0u);
  core::shuffle(order, random);
  for (const std::uint32_t n : order) {
    if (packing_.fits(n)) packing_.insert(n);
  }
  work_ += packing_.take_work();
  best_total_ = packing_.total();
  best_members_ = packing_.members();
}

// False where there is nothing to do.
bool SwapSearch::step(core::Random& random) {
  ++time_;
  const std::uint32_t arrival = best_arrival(random);
  if (arrival == kNone || packing_.gain(arrival) < 0) {
    const std::uint32_t least = least_member();
    if (arrival == kNone && least == kNone) return false;
    if (arrival == kNone || (least != kNone && packing_.gain(arrival) < -rivals_.value(least))) {
      remove(least, kTenure);
      return true;
    }
  }
  const std::uint64_t tenure =
      kTenure + random.below(1 + packing_.members().size() / kMembersPerTenure);
  for (const std::uint32_t rival : rivals_[arrival]) {
    if (packing_.contains(rival)) remove(rival, tenure);
  }
  packing_.insert(arrival);
  work_ += packing_.take_work();
  return true;
}

// Of equal ones the first from a random block on.  One that may not come back may nevertheless, if
// that makes the best packing.
std::uint32_t SwapSearch::best_arrival(core::Random& random) {
  work_ += kWorkPerLook * static_cast<double>(rivals_.num_arcs());
  const std::vector<double>& gain = packing_.gains();
  const double enough = best_total_ * (1 + kBetter) - packing_.total();
  std::uint32_t best = kNone;
  double most = -kInfinity;
  std::erase_if(tabu_, [&](std::uint32_t n) {
    if (packing_.contains(n)) return true;
    if (tabu_until_[n] <= time_) {
      closed_[n] = 0;
      return true;
    }
    if (gain[n] > std::max(most, enough)) {
      most = gain[n];
      best = n;
    }
    return false;
  });
  const std::size_t num_blocks = block_most_.size();
  for (std::size_t b = 0; b < num_blocks; ++b)
    block_most_[b] = most_of(&gain[b * kBlock], &closed_[b * kBlock]);
  const std::size_t first = random.below(num_blocks);
  std::size_t block = num_blocks;
  for (std::size_t i = 0; i < num_blocks; ++i) {
    const std::size_t b = (first + i) % num_blocks;
    if (block_most_[b] <= most) continue;
    most = block_most_[b];
    block = b;
  }
  if (block == num_blocks) return best;
  std::size_t n = block * kBlock;
  while (gain[n] + closed_[n] != most) ++n;
  return static_cast<std::uint32_t>(n);
}

std::uint32_t SwapSearch::least_member() const {
  const std::vector<std::uint32_t>& members = packing_.members();
  const auto least = std::min_element(members.begin(), members.end(), [&](auto a, auto b) {
    return rivals_.value(a) < rivals_.value(b);
  });
  return least == members.end() ? kNone : *least;
}

void SwapSearch::remove(std::uint32_t n, std::uint64_t tenure) {
  packing_.remove(n);
  closed_[n] = -kInfinity;
  tabu_until_[n] = time_ + tenure;
  tabu_.push_back(n);
}

}  // namespace nda::recovery
