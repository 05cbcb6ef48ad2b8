#include "recovery/swap_search.hpp"

#include <algorithm>
#include <numeric>

#include "core/cheapest.hpp"

// Where the linear relaxation is far off, slack is no guide, and a neighbourhood that can be
// searched exactly is small.  But there steps cost little: the gain of every arc is kept up to
// date, a step changes those of the arcs that exclude the ones that came or left, and the best of a
// thousand gains is found at once.
//
// Wu, Hao & Glover choose among adding, swapping one for one and dropping.  Here any number may
// leave for one that comes, since arcs of many indices seldom exclude but one; dropping is what is
// left when every arrival loses more.

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr std::uint64_t kTenure = 7;            // Wu, Hao & Glover 2012
constexpr std::uint64_t kMembersPerTenure = 2;  // a longer one at random, where more are in
constexpr std::uint64_t kPatience = 4000;       // steps without a better packing
constexpr double kBetter = 1e-9;
// A gain looked at, one changed, as work.
constexpr double kWorkPerLook = 0.25;
constexpr double kWorkPerChange = 0.5;
constexpr std::uint64_t kStepsPerLook = 64;  // at the clock

}  // namespace

SwapSearch::SwapSearch(const bnb::SlackProblem& problem) : problem_(problem) {
  arcs_.resize(problem.num_arcs());
  std::iota(arcs_.begin(), arcs_.end(), 0u);
  core::keep_cheapest(arcs_, kMostArcs, [&](std::uint32_t a) { return problem.reduced(a); });
  for (const std::uint32_t a : arcs_) {
    double value = -problem.reduced(a);
    for (const bnb::RowUse& use : problem.uses(a))
      value += problem.price(use.row) * use.coefficient;
    value_.push_back(value);
  }
  list_rivals();
}

void SwapSearch::list_rivals() {
  const auto num_arcs = static_cast<std::uint32_t>(arcs_.size());
  const auto for_each_index = [&](std::uint32_t n, auto&& visit) {
    for (const bnb::RowUse& use : problem_.uses(arcs_[n])) {
      if (use.row >= problem_.num_indices()) break;
      visit(use.row);
    }
  };
  const core::Lists<std::uint32_t> of_index(problem_.num_indices(), [&](auto&& visit) {
    for (std::uint32_t n = 0; n < num_arcs; ++n)
      for_each_index(n, [&](std::uint32_t index) { visit(index, n); });
  });
  std::vector<std::uint32_t> seen_by(num_arcs, kNone);
  rivals_ = core::Lists<std::uint32_t>(num_arcs, [&](auto&& visit) {
    std::fill(seen_by.begin(), seen_by.end(), kNone);
    for (std::uint32_t n = 0; n < num_arcs; ++n) {
      seen_by[n] = n;
      for_each_index(n, [&](std::uint32_t index) {
        work_ += static_cast<double>(of_index[index].size());
        for (const std::uint32_t rival : of_index[index]) {
          if (seen_by[rival] == n) continue;
          seen_by[rival] = n;
          visit(n, rival);
        }
      });
    }
  });
}

double SwapSearch::run(const Limits& limits,
                       core::Random& random,
                       const std::function<void(std::vector<std::uint32_t>)>& found) {
  const auto stopped = [&] {
    return work_ >= limits.max_work || (time_ % kStepsPerLook == 0 && limits.deadline.reached());
  };
  while (!arcs_.empty() && !stopped()) {
    start(random);
    std::vector<std::uint32_t> best = packing();
    std::uint64_t patient_until = kPatience;
    while (time_ < patient_until && !stopped() && step(random)) {
      if (total_ <= best_total_ * (1 + kBetter)) continue;
      best_total_ = total_;
      best = packing();
      patient_until = time_ + kPatience;
    }
    found(std::move(best));
  }
  return work_;
}

// A random packing to which nothing can be added.
void SwapSearch::start(core::Random& random) {
  time_ = 0;
  gain_ = value_;
  is_member_.assign(arcs_.size(), 0);
  place_.assign(arcs_.size(), 0);
  tabu_until_.assign(arcs_.size(), 0);
  members_.clear();
  total_ = 0;
  std::vector<std::uint32_t> order(arcs_.size());
  std::iota(order.begin(), order.end(), 0u);
  core::shuffle(order, random);
  for (const std::uint32_t n : order) {
    const auto rivals = rivals_[n];
    if (std::none_of(rivals.begin(), rivals.end(), [&](auto r) { return is_member_[r] != 0; }))
      insert(n);
  }
  best_total_ = total_;
}

// False where there is nothing to do.
bool SwapSearch::step(core::Random& random) {
  ++time_;
  const std::uint32_t arrival = best_arrival(random);
  const std::uint32_t least = least_member();
  if (arrival == kNone && least == kNone) return false;
  if (arrival == kNone || (least != kNone && gain_[arrival] < -value_[least])) {
    remove(least, kTenure);
    return true;
  }
  const std::uint64_t tenure = kTenure + random.below(1 + members_.size() / kMembersPerTenure);
  for (const std::uint32_t rival : rivals_[arrival]) {
    if (is_member_[rival] != 0) remove(rival, tenure);
  }
  insert(arrival);
  return true;
}

// Of equal ones the first from a random one on.  One that may not come back may nevertheless, if
// that makes the best packing.
std::uint32_t SwapSearch::best_arrival(core::Random& random) const {
  std::uint32_t best = kNone;
  double most = -kInfinity;
  const auto look = [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (gain_[n] <= most || is_member_[n] != 0) continue;
      if (tabu_until_[n] > time_ && total_ + gain_[n] <= best_total_ * (1 + kBetter)) continue;
      most = gain_[n];
      best = static_cast<std::uint32_t>(n);
    }
  };
  const std::size_t middle = random.below(arcs_.size());
  look(middle, arcs_.size());
  look(0, middle);
  return best;
}

std::uint32_t SwapSearch::least_member() const {
  const auto least = std::min_element(
      members_.begin(), members_.end(), [&](auto a, auto b) { return value_[a] < value_[b]; });
  return least == members_.end() ? kNone : *least;
}

void SwapSearch::insert(std::uint32_t n) {
  is_member_[n] = 1;
  place_[n] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(n);
  total_ += value_[n];
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] -= value_[n];
  work_ += kWorkPerLook * static_cast<double>(arcs_.size()) +
           kWorkPerChange * static_cast<double>(rivals_[n].size());
}

void SwapSearch::remove(std::uint32_t n, std::uint64_t tenure) {
  is_member_[n] = 0;
  members_[place_[n]] = members_.back();
  place_[members_.back()] = place_[n];
  members_.pop_back();
  total_ -= value_[n];
  for (const std::uint32_t rival : rivals_[n]) gain_[rival] += value_[n];
  tabu_until_[n] = time_ + tenure;
  work_ += kWorkPerChange * static_cast<double>(rivals_[n].size());
}

std::vector<std::uint32_t> SwapSearch::packing() const {
  std::vector<std::uint32_t> arcs;
  for (const std::uint32_t n : members_) arcs.push_back(arcs_[n]);
  std::sort(arcs.begin(), arcs.end());
  return arcs;
}

}  // namespace nda::recovery
