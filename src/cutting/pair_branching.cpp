#include "cutting/pair_branching.hpp"

#include <algorithm>
#include <cmath>

// Branching on a pair of rows keeps both children packing problems and halves the fractional point
// on both sides, where fixing one arc to 0 would change next to nothing.  Which pair: a few with a
// weight near a half are tried, by some dual simplex steps each, and the product of what their two
// children gain decides (strong branching, Applegate et al. 1995).

namespace nda::cutting {

using core::ArcId;

namespace {

constexpr double kIntegral = 1e-6;
constexpr std::size_t kCandidates = 4;
constexpr int kTrialIterations = 30;

}  // namespace

std::vector<PairBranching::Pair> PairBranching::fractional_pairs() const {
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> slots;
  for (std::size_t k = 0; k < master_.arcs().size(); ++k) {
    const double x = master_.values()[k];
    if (x <= kIntegral || x >= 1 - kIntegral) continue;
    slots.clear();
    core::for_each_slot(component_, master_.arcs()[k], [&](std::uint32_t slot) {
      for (const std::uint32_t other : slots) pairs.push_back({other, slot, x});
      slots.push_back(slot);
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  });
  std::vector<Pair> merged;
  for (const Pair& pair : pairs) {
    if (!merged.empty() && merged.back().first == pair.first && merged.back().second == pair.second)
      merged.back().weight += pair.weight;
    else
      merged.push_back(pair);
  }
  std::erase_if(merged, [](const Pair& pair) { return pair.weight >= 1 - kIntegral; });
  return merged;
}

std::vector<PairBranching::Pair> PairBranching::open_pairs() const {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < master_.arcs().size(); ++k) {
    if (master_.values()[k] > 0.5) add_open_pairs(master_.arcs()[k], 1, pairs);
  }
  for (const ArcId a : master_.live()) {
    if (!pairs.empty()) break;
    if (!master_.forbidden(a)) add_open_pairs(a, 0, pairs);
  }
  return pairs;
}

void PairBranching::add_open_pairs(ArcId a, double weight, std::vector<Pair>& pairs) const {
  std::vector<std::uint32_t> slots;
  core::for_each_slot(component_, a, [&](std::uint32_t slot) {
    for (const std::uint32_t other : slots) {
      if (is_open({other, slot, weight})) pairs.push_back({other, slot, weight});
    }
    slots.push_back(slot);
  });
}

// Some packing left may lack an arc that uses both.
bool PairBranching::is_open(const Pair& pair) const {
  const std::vector<ArcId> one = arcs_of_one(pair);
  return !master_.forced(pair.first) ||
         std::ranges::any_of(one, [&](ArcId a) { return !master_.forbidden(a); });
}

PairBranching::Choice PairBranching::choose(std::vector<Pair> pairs, double cutoff) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::abs(a.weight - 0.5) < std::abs(b.weight - 0.5);
  });
  if (pairs.size() > kCandidates) pairs.resize(kCandidates);
  const std::vector<unsigned char> basis = master_.basis();
  const double lower = master_.lower();
  const auto trial = [&] { return master_.trial(kTrialIterations, deadline_); };
  Choice best{};
  double best_score = -1;
  for (const Pair& pair : pairs) {
    Choice choice{pair, 0, 0};
    together(pair, [&] { choice.together = trial(); });
    master_.set_basis(basis);
    apart(pair, [&] { choice.apart = trial(); });
    master_.set_basis(basis);
    const auto gain = [&](double bound) { return std::max(1e-6, std::min(bound, cutoff) - lower); };
    const double score = gain(choice.together) * gain(choice.apart);
    if (score > best_score) {
      best_score = score;
      best = choice;
    }
  }
  return best;
}

void PairBranching::descend(const Step& step) {
  if (!step.is_together) return master_.forbid(arcs_of_both(step.pair));
  master_.forbid(arcs_of_one(step.pair));
  master_.force(step.pair.first);
}

bool PairBranching::uses(ArcId a, std::uint32_t slot) const {
  bool found = false;
  core::for_each_slot(component_, a, [&](std::uint32_t s) { found = found || s == slot; });
  return found;
}

std::vector<ArcId> PairBranching::arcs_of_one(const Pair& pair) const {
  std::vector<ArcId> arcs;
  for (const ArcId a : master_.index()[pair.first]) {
    if (!uses(a, pair.second)) arcs.push_back(a);
  }
  for (const ArcId a : master_.index()[pair.second]) {
    if (!uses(a, pair.first)) arcs.push_back(a);
  }
  return arcs;
}

std::vector<ArcId> PairBranching::arcs_of_both(const Pair& pair) const {
  std::vector<ArcId> arcs;
  for (const ArcId a : master_.index()[pair.first]) {
    if (uses(a, pair.second)) arcs.push_back(a);
  }
  return arcs;
}

}  // namespace nda::cutting
