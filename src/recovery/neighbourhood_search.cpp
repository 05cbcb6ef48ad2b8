#include "recovery/neighbourhood_search.hpp"

#include <algorithm>

// Half of the neighbourhoods start where the packing loses most against the multipliers (the
// reduced cost of the owner, the price of an uncovered index), the others anywhere.  Their size
// follows what the subproblem solver can finish: it grows while searches are complete, fast at
// first, and shrinks when they are not (adaptive as in Pisinger & Ropke 2010).  Neighbourhoods that
// found no more arcs to take out say nothing of larger ones.
//
// A detour may cost no more than the neighbourhood's share of the gap, which is that of its
// indices.  A tenth of the whole gap, which is right over dozens of indices, lets each of thousands
// of small neighbourhoods lead away from a good packing by more than all of them together can gain.
//
// Neighbourhoods that are searched at once all start from the same packing.  They are filled one
// after the other, and what no longer fits is forgotten.  Where that happens fewer are searched at
// once: over few indices they meet, over many they hardly ever do.

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = SlackPacking::kNone;
constexpr double kFirstSize = 4;
constexpr double kLeastSize = 2;
constexpr double kFirstGrowth = 1;  // until the first search that is not complete
constexpr double kGrowth = 0.05;
constexpr double kShrinking = 0.5;
constexpr double kWorkPerAttempt = 3e5;  // a millisecond
constexpr double kBetter = 1e-9;
// Shares of the gap: what a detour may cost at most, and how far they may lead from the best
// packing.
constexpr double kMostDetour = 0.1;
constexpr double kFarthest = 0.3;
constexpr std::size_t kMostAtOnce = 8;

}  // namespace

NeighbourhoodSearch::NeighbourhoodSearch(const bnb::SlackProblem& problem)
    : problem_(problem), state_(problem) {
  list_arcs();
}

void NeighbourhoodSearch::list_arcs() {
  arcs_ = core::Lists<std::uint32_t>(problem_.num_indices(), [&](auto&& visit) {
    for (std::uint32_t arc = 0; arc < problem_.num_arcs(); ++arc) {
      for (const bnb::RowUse& use : problem_.index_uses(arc)) visit(use.row, arc);
    }
  });
  for (std::uint32_t index = 0; index < problem_.num_indices(); ++index) {
    const std::span<std::uint32_t> arcs = arcs_.list(index);
    std::sort(arcs.begin(), arcs.end(), [&](std::uint32_t a, std::uint32_t b) {
      const double ra = problem_.reduced(a);
      const double rb = problem_.reduced(b);
      return ra != rb ? ra < rb : a < b;
    });
    if (!arcs.empty()) inner_.push_back(index);
    arc_share_ += static_cast<double>(arcs.size());
  }
  arc_share_ /= static_cast<double>(std::max<std::size_t>(1, problem_.num_arcs() * inner_.size()));
}

double NeighbourhoodSearch::improve(std::vector<std::uint32_t>& best,
                                    const Limits& limits,
                                    core::Random& random) {
  if (inner_.empty()) return 0;
  state_.assign(best);
  double best_slack = state_.slack();
  double size = kFirstSize;
  double growth = kFirstGrowth;
  double work = 0;
  std::size_t at_once = 1;
  bnb::SlackLimits search;
  search.max_work = kWorkPerAttempt;
  search.deadline = limits.deadline;
  while (work < limits.max_work && best_slack > limits.goal && !limits.deadline.reached()) {
    const double gap = best_slack - std::max(0.0, limits.goal);
    const double affordable = 1 + (limits.max_work - work) / kWorkPerAttempt;  // perhaps infinite
    const auto count = static_cast<std::size_t>(std::min(static_cast<double>(at_once), affordable));
    while (neighbourhoods_.size() < count) neighbourhoods_.emplace_back(problem_, arcs_, state_);
    const double most_rise = std::min(kMostDetour, size * arc_share_) * gap;
    for (std::size_t n = 0; n < count; ++n)
      neighbourhoods_[n].choose(
          choose_seed(random), static_cast<std::size_t>(size), most_rise, random);
    limits.for_all(count,
                   [&](std::size_t n) { neighbourhoods_[n].search(limits.most_reduced, search); });
    bool met = false;
    for (std::size_t n = 0; n < count; ++n) {
      const Neighbourhood& neighbourhood = neighbourhoods_[n];
      work += neighbourhood.work();
      if (!neighbourhood.is_complete()) growth = kGrowth;
      if (!neighbourhood.is_complete())
        size = std::max(kLeastSize, size - kShrinking);
      else if (neighbourhood.size() >= static_cast<std::size_t>(size))
        size += growth;
      if (!neighbourhood.has_found()) continue;
      met = !neighbourhood.fill(state_) || met;
      if (state_.slack() < best_slack * (1 - kBetter)) {
        best = state_.arcs();
        best_slack = state_.slack();
      } else if (state_.slack() > best_slack + kFarthest * gap) {
        state_.assign(best);
      }
    }
    at_once = met ? (at_once + 1) / 2 : std::min(kMostAtOnce, at_once + 1);
  }
  return work;
}

double NeighbourhoodSearch::blame(std::uint32_t index) const {
  const std::uint32_t arc = state_.owner(index);
  return arc == kNone ? problem_.price(index)
                      : problem_.reduced(arc) / static_cast<double>(problem_.uses(arc).size());
}

// Half of the seeds: the one with the largest share of the slack among a few.
std::uint32_t NeighbourhoodSearch::choose_seed(core::Random& random) const {
  constexpr int kDraws = 8;
  const auto draw = [&] { return inner_[random.below(inner_.size())]; };
  std::uint32_t seed = draw();
  if (random.below(2) == 0) return seed;
  for (int n = 1; n < kDraws; ++n) {
    const std::uint32_t other = draw();
    if (blame(other) > blame(seed)) seed = other;
  }
  return seed;
}

}  // namespace nda::recovery
