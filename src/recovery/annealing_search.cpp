#include "recovery/annealing_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

// A tabu search always takes the best swap, so it ends where good swaps lead, and a start that
// leads elsewhere is a matter of luck.  Where arcs exclude few others (a packing has many members)
// there are more such places than starts.  Annealing (Kirkpatrick, Gelatt & Vecchi 1983) goes
// wherever chance and temperature let it: an arc drawn at random comes in, throwing out what
// excludes it, with probability exp(gain / temperature) where that loses.  A trial that fails, as
// most do, is a look at one gain, and no neighbourhood is ever listed.
//
// Annealed packings agree on most of their arcs, and what they agree on is mostly right.  So a
// small population of them (a memetic algorithm, Moscato 1989) spends its time where they differ,
// as CHILS (Karlsruhe 2025) does.  What is ours is to anneal the differences, from hot to cold at
// once as they are few, and the whole from a moderate heat afterwards, which moves the child by
// some arcs that its parents agreed on.  Replacing the worse parent, not the worst of all, keeps
// packings apart that have little in common.  When the whole population has become one family no
// child gets in, and the next one starts afresh, but for the best of a few before it: small
// families that meet now and then find what a large one does not.
//
// Tried and dropped: annealing alone, however slow; the differences without the whole; larger
// populations.

namespace nda::recovery {
namespace {

constexpr std::size_t kPopulation = 8;
constexpr std::size_t kAncestors = 4;  // populations that count
constexpr int kPatience = 60;          // children that get nobody any further

// Temperatures as shares of the mean value.
constexpr double kHot = 0.25;
constexpr double kWarm = 0.12;
constexpr double kCold = 0.1;
constexpr double kFirstTrials = 10000;  // per arc, of every first packing
constexpr double kDifferenceTrials = 4000;
constexpr double kWholeTrials = 2000;
constexpr double kLeastShare = 0.02;

constexpr int kTrialsPerLook = 1024;  // at the clock, and per temperature
constexpr double kWorkPerTrial = 0.3;
constexpr double kBetter = 1e-9;

// ln of numbers evenly spread in (0, 1): with temperature * one of them drawn at random as the
// least gain allowed, exp(gain / temperature) is the probability to succeed.
constexpr std::size_t kNumLogs = 1024;

std::array<double, kNumLogs> make_logs() {
  std::array<double, kNumLogs> logs;
  for (std::size_t i = 0; i < kNumLogs; ++i)
    logs[i] = std::log((static_cast<double>(i) + 0.5) / kNumLogs);
  return logs;
}

const std::array<double, kNumLogs> kLogs = make_logs();

}  // namespace

double AnnealingSearch::run(const Limits& limits,
                            core::Random& random,
                            const std::function<void(std::vector<std::uint32_t>)>& found) {
  if (rivals_.num_arcs() == 0) return 0;
  const std::span<const double> values = rivals_.values();
  const auto num_arcs = static_cast<double>(values.size());
  mean_value_ = std::accumulate(values.begin(), values.end(), 0.0) / num_arcs;
  const double trials = kPopulation * kFirstTrials + kPatience * kWholeTrials;
  share_ = std::clamp(limits.max_work / (kWorkPerTrial * num_arcs * trials), kLeastShare, 1.0);
  all_.resize(values.size());
  std::iota(all_.begin(), all_.end(), 0u);
  population_.clear();
  if (ancestors_.size() == kAncestors) population_ = std::exchange(ancestors_, {});
  while (population_.size() < kPopulation && !stopped(limits))
    population_.push_back(first_packing(limits, random));
  for (int failed = 0;
       population_.size() == kPopulation && failed < kPatience && !stopped(limits);) {
    const std::size_t one = random.below(kPopulation);
    const std::size_t other = (one + 1 + random.below(kPopulation - 1)) % kPopulation;
    Living& a = population_[one];
    Living& b = population_[other];
    failed = settle(child(a, b, limits, random), a.total < b.total ? a : b) ? 0 : failed + 1;
  }
  if (!population_.empty()) remember_best();
  for (const Living& living : population_) found(rivals_.arcs_of_problem(living.members));
  return std::exchange(work_, 0.0);
}

bool AnnealingSearch::stopped(const Limits& limits) const {
  return work_ >= limits.max_work || limits.deadline.reached();
}

AnnealingSearch::Living AnnealingSearch::first_packing(const Limits& limits, core::Random& random) {
  packing_.clear();
  anneal(all_, {kHot, kCold}, kFirstTrials, limits, random);
  return best();
}

AnnealingSearch::Living AnnealingSearch::child(const Living& one,
                                               const Living& other,
                                               const Limits& limits,
                                               core::Random& random) {
  Members common;
  std::set_intersection(one.members.begin(),
                        one.members.end(),
                        other.members.begin(),
                        other.members.end(),
                        std::back_inserter(common));
  packing_.assign(common);
  std::vector<std::uint32_t> open;
  for (const std::uint32_t n : all_) {
    if (packing_.fits(n)) open.push_back(n);
  }
  anneal(open, {kHot, kCold}, kDifferenceTrials, limits, random);
  packing_.assign(best_members_);
  anneal(all_, {kWarm, kCold}, kWholeTrials, limits, random);
  return best();
}

// Whether the child is better than the parent.  It takes its place if it is no worse, and no twin
// of another one.
bool AnnealingSearch::settle(Living child, Living& parent) {
  const bool is_twin =
      std::any_of(population_.begin(), population_.end(), [&](const Living& other) {
        return other.members == child.members;
      });
  if (is_twin || child.total < parent.total * (1 - kBetter)) return false;
  const bool is_better = child.total > parent.total * (1 + kBetter);
  parent = std::move(child);
  return is_better;
}

void AnnealingSearch::remember_best() {
  const auto best = std::max_element(
      population_.begin(), population_.end(), [](const Living& a, const Living& b) {
        return a.total < b.total;
      });
  const bool is_known = std::any_of(ancestors_.begin(), ancestors_.end(), [&](const Living& other) {
    return other.members == best->members;
  });
  if (!is_known) ancestors_.push_back(*best);
}

// From the packing at hand; the best on the way is kept.
void AnnealingSearch::anneal(std::span<const std::uint32_t> arcs,
                             Heat heat,
                             double trials_per_arc,
                             const Limits& limits,
                             core::Random& random) {
  best_total_ = packing_.total();
  best_members_ = packing_.members();
  if (arcs.empty()) return;
  const double trials = share_ * trials_per_arc * static_cast<double>(arcs.size());
  const int looks = 1 + static_cast<int>(trials / kTrialsPerLook);
  double temperature = heat.first * mean_value_;
  const double cooling = std::pow(heat.last / heat.first, 1.0 / looks);
  for (int look = 0; look < looks && !limits.deadline.reached(); ++look) {
    try_arcs(arcs, temperature, random);
    temperature *= cooling;
  }
  for (const std::uint32_t n : arcs) {
    if (packing_.fits(n)) packing_.insert(n);
  }
  keep_best();
}

// The stream of random numbers is copied so that it stays in registers.
void AnnealingSearch::try_arcs(std::span<const std::uint32_t> arcs,
                               double temperature,
                               core::Random& random) {
  core::Random draw = random;
  const double* const gain = packing_.gains().data();
  const std::uint64_t num_arcs = arcs.size();
  for (int trial = 0; trial < kTrialsPerLook; ++trial) {
    const std::uint64_t bits = draw();
    const std::uint32_t n = arcs[((bits >> 32) * num_arcs) >> 32];
    if (gain[n] > temperature * kLogs[bits % kNumLogs]) force(n);
  }
  random = draw;
  work_ += kWorkPerTrial * kTrialsPerLook + packing_.take_work();
}

// A packing is worth a look only where it is about to get worse.
void AnnealingSearch::force(std::uint32_t n) {
  if (packing_.gain(n) >= 0) {
    gained_ = true;
  } else if (gained_) {
    keep_best();
    gained_ = false;
  }
  for (const std::uint32_t rival : rivals_[n]) {
    if (packing_.contains(rival)) packing_.remove(rival);
  }
  packing_.insert(n);
}

void AnnealingSearch::keep_best() {
  if (packing_.total() <= best_total_ * (1 + kBetter)) return;
  best_total_ = packing_.total();
  best_members_ = packing_.members();
}

AnnealingSearch::Living AnnealingSearch::best() const {
  Living living{best_members_, best_total_};
  std::sort(living.members.begin(), living.members.end());
  return living;
}

}  // namespace nda::recovery
