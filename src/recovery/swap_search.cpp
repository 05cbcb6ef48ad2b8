#include "recovery/swap_search.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "core/cheapest.hpp"

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
// A gain looked at, one changed, as work.
constexpr double kWorkPerLook = 0.1;
constexpr double kWorkPerChange = 0.25;
constexpr std::uint64_t kStepsPerLook = 64;  // at the clock

// Arcs that are looked at together, so that the processor's vector unit takes several at once.
constexpr std::size_t kBlock = 64;

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

SwapSearch::SwapSearch(const bnb::SlackProblem& problem) : problem_(problem) {
  const auto value = [&](std::uint32_t a) {
    double saved = -problem.reduced(a);
    for (const bnb::RowUse& use : problem.uses(a))
      saved += problem.price(use.row) * use.coefficient;
    return saved;
  };
  for (std::uint32_t a = 0; a < problem.num_arcs(); ++a) {
    if (value(a) > 0) arcs_.push_back(a);
  }
  core::keep_cheapest(arcs_, kMostArcs, [&](std::uint32_t a) { return problem.reduced(a); });
  for (const std::uint32_t a : arcs_) value_.push_back(value(a));
  list_rivals();
}

void SwapSearch::list_rivals() {
  const auto num_arcs = static_cast<std::uint32_t>(arcs_.size());
  const core::Lists<std::uint32_t> of_index(problem_.num_indices(), [&](auto&& visit) {
    for (std::uint32_t n = 0; n < num_arcs; ++n) {
      for (const bnb::RowUse& use : problem_.index_uses(arcs_[n])) visit(use.row, n);
    }
  });
  std::vector<std::uint32_t> seen_by(num_arcs, kNone);
  rivals_ = core::Lists<std::uint32_t>(num_arcs, [&](auto&& visit) {
    std::fill(seen_by.begin(), seen_by.end(), kNone);
    for (std::uint32_t n = 0; n < num_arcs; ++n) {
      seen_by[n] = n;
      for (const bnb::RowUse& use : problem_.index_uses(arcs_[n])) {
        work_ += static_cast<double>(of_index[use.row].size());
        for (const std::uint32_t rival : of_index[use.row]) {
          if (seen_by[rival] == n) continue;
          seen_by[rival] = n;
          visit(n, rival);
        }
      }
    }
  });
}

double SwapSearch::run(const Limits& limits,
                       core::Random& random,
                       const std::function<void(std::vector<std::uint32_t>)>& found) {
  for (std::size_t n = 0; n < limits.max_starts && !arcs_.empty() && !stopped(limits); ++n) {
    start(random);
    std::uint64_t patient_until = kPatience;
    while (time_ < patient_until && !stopped(limits) && step(random)) {
      if (total_ <= best_total_ * (1 + kBetter)) continue;
      best_total_ = total_;
      best_members_ = members_;
      patient_until = time_ + kPatience;
    }
    if (best_total_ > elite_total_) {
      elite_ = best_members_;
      elite_total_ = best_total_;
    }
    found(packing(best_members_));
  }
  return std::exchange(work_, 0.0);
}

bool SwapSearch::stopped(const Limits& limits) const {
  return work_ >= limits.max_work || (time_ % kStepsPerLook == 0 && limits.deadline.reached());
}

// A packing to which nothing can be added: at random, or after a part of the best one found.
void SwapSearch::start(core::Random& random) {
  time_ = 0;
  const std::size_t num_blocks = (arcs_.size() + kBlock - 1) / kBlock;
  block_most_.resize(num_blocks);
  gain_ = value_;
  gain_.resize(num_blocks * kBlock, 0.0);
  closed_.assign(arcs_.size(), 0.0);
  closed_.resize(num_blocks * kBlock, -kInfinity);
  tabu_.clear();
  is_member_.assign(arcs_.size(), 0);
  place_.assign(arcs_.size(), 0);
  tabu_until_.assign(arcs_.size(), 0);
  members_.clear();
  total_ = 0;
  if (num_starts_++ % kStartsPerRandom != 0) {
    for (const std::uint32_t n : elite_) {
      if (random.uniform() < kKept) insert(n);
    }
  }
  std::vector<std::uint32_t> order(arcs_.size());
  std::iota(order.begin(), order.end(), 0u);
  core::shuffle(order, random);
  for (const std::uint32_t n : order) insert_if_free(n);
  best_total_ = total_;
  best_members_ = members_;
}

void SwapSearch::insert_if_free(std::uint32_t n) {
  const auto rivals = rivals_[n];
  if (is_member_[n] == 0 &&
      std::none_of(rivals.begin(), rivals.end(), [&](auto r) { return is_member_[r] != 0; }))
    insert(n);
}

// False where there is nothing to do.
bool SwapSearch::step(core::Random& random) {
  ++time_;
  const std::uint32_t arrival = best_arrival(random);
  if (arrival == kNone || gain_[arrival] < 0) {
    const std::uint32_t least = least_member();
    if (arrival == kNone && least == kNone) return false;
    if (arrival == kNone || (least != kNone && gain_[arrival] < -value_[least])) {
      remove(least, kTenure);
      return true;
    }
  }
  const std::uint64_t tenure = kTenure + random.below(1 + members_.size() / kMembersPerTenure);
  for (const std::uint32_t rival : rivals_[arrival]) {
    if (is_member_[rival] != 0) remove(rival, tenure);
  }
  insert(arrival);
  return true;
}

// Of equal ones the first from a random block on.  One that may not come back may nevertheless, if
// that makes the best packing.
std::uint32_t SwapSearch::best_arrival(core::Random& random) {
  work_ += kWorkPerLook * static_cast<double>(arcs_.size());
  const double enough = best_total_ * (1 + kBetter) - total_;
  std::uint32_t best = kNone;
  double most = -kInfinity;
  std::erase_if(tabu_, [&](std::uint32_t n) {
    if (is_member_[n] != 0) return true;
    if (tabu_until_[n] <= time_) {
      closed_[n] = 0;
      return true;
    }
    if (gain_[n] > std::max(most, enough)) {
      most = gain_[n];
      best = n;
    }
    return false;
  });
  const std::size_t num_blocks = block_most_.size();
  for (std::size_t b = 0; b < num_blocks; ++b)
    block_most_[b] = most_of(&gain_[b * kBlock], &closed_[b * kBlock]);
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
  while (gain_[n] + closed_[n] != most) ++n;
  return static_cast<std::uint32_t>(n);
}

std::uint32_t SwapSearch::least_member() const {
  const auto least = std::min_element(
      members_.begin(), members_.end(), [&](auto a, auto b) { return value_[a] < value_[b]; });
  return least == members_.end() ? kNone : *least;
}

void SwapSearch::insert(std::uint32_t n) {
  is_member_[n] = 1;
  closed_[n] = -kInfinity;
  place_[n] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(n);
  total_ += value_[n];
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] -= value_[n];
  work_ += kWorkPerChange * static_cast<double>(rivals_[n].size());
}

void SwapSearch::remove(std::uint32_t n, std::uint64_t tenure) {
  is_member_[n] = 0;
  members_[place_[n]] = members_.back();
  place_[members_.back()] = place_[n];
  members_.pop_back();
  total_ -= value_[n];
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] += value_[n];
  tabu_until_[n] = time_ + tenure;
  tabu_.push_back(n);
  work_ += kWorkPerChange * static_cast<double>(rivals_[n].size());
}

// The arcs of the problem.
std::vector<std::uint32_t> SwapSearch::packing(std::span<const std::uint32_t> members) const {
  std::vector<std::uint32_t> arcs = core::at_positions(arcs_, members);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

}  // namespace nda::recovery
