#include "recovery/neighbourhood_search.hpp"

#include <algorithm>

#include "bnb/slack_search.hpp"

// Neighbourhoods grow along arcs that might replace what is there: from a freed index over one of
// its cheap arcs to the owners of that arc's other indices.  Half of them start where the packing
// loses most against the multipliers (the reduced cost of the owner, the price of an uncovered
// index), the others anywhere.  Their size follows what the subproblem solver can finish: it grows
// while searches are complete and shrinks when they are not (adaptive as in Pisinger & Ropke 2010).

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;

constexpr std::uint32_t kNoRow = ~std::uint32_t{0};
constexpr double kFirstSize = 4;
constexpr double kLeastSize = 2;
constexpr double kGrowth = 0.05;
constexpr double kShrinking = 0.5;
constexpr double kWorkPerAttempt = 3e5;    // a millisecond
constexpr double kWorkOfSettingUp = 5000;  // even where nothing is looked at
constexpr std::uint64_t kChoices = 12;     // cheap arcs of an index
constexpr int kStepsPerArc = 20;
constexpr double kBetter = 1e-9;
constexpr std::uint64_t kAttemptsPerDetour = 4;
// Shares of the gap: what a detour may cost, and how far they may lead from the best packing.
constexpr double kDetour = 0.1;
constexpr double kFarthest = 0.3;

}  // namespace

NeighbourhoodSearch::NeighbourhoodSearch(const Component& component,
                                         std::span<const double> u,
                                         const core::Deadline& deadline)
    : component_(component),
      reduced_(reduced_costs(component, u)),
      slot_arcs_(component, reduced_, deadline),
      arc_slots_(component),
      state_(component),
      is_freed_(component.num_slots(), 0),
      row_(component.num_slots(), kNoRow),
      listed_(component.num_arcs(), 0) {
  for (std::uint32_t slot = 0; slot < component.num_slots(); ++slot) {
    price_.push_back(std::max(0.0, -u[slot]));
    if (!slot_arcs_[slot].empty()) used_.push_back(slot);
  }
}

void NeighbourhoodSearch::improve(core::Packing& packing,
                                  double max_work,
                                  double goal,
                                  core::Random& random,
                                  const core::Deadline& deadline) {
  if (used_.empty()) return;
  state_.assign(packing);
  double size = kFirstSize;
  for (double work = 0; work < max_work && packing.cost > goal;) {
    if (deadline.reached()) break;
    free_around(choose_seed(random), static_cast<std::size_t>(size), random);
    const double gap = goal > -kInfinity ? packing.cost - goal : 0;
    const bool detour = !freed_.empty() && random.below(kAttemptsPerDetour) == 0;
    const Attempt attempt = detour ? refill(freed_[random.below(freed_.size())],
                                            random.uniform(0, kDetour) * gap,
                                            deadline)
                                   : refill(kNoArc, 0, deadline);
    work += attempt.work + kWorkOfSettingUp + static_cast<double>(looked_at_);
    size = attempt.complete ? size + kGrowth : std::max(kLeastSize, size - kShrinking);
    if (state_.cost() < packing.cost) {
      const core::Packing found = state_.packing();
      if (found.cost < packing.cost) packing = found;
    } else if (state_.cost() > packing.cost + kFarthest * gap) {
      state_.assign(packing);
    }
  }
}

double NeighbourhoodSearch::blame(std::uint32_t slot) const {
  const ArcId owner = state_.owner(slot);
  if (owner == kNoArc) return price_[slot];
  return reduced_[owner] / static_cast<double>(arc_slots_[owner].size());
}

// Half of the seeds: the one with the largest share of the slack among a few.
std::uint32_t NeighbourhoodSearch::choose_seed(core::Random& random) const {
  constexpr int kDraws = 8;
  const auto draw = [&] { return used_[random.below(used_.size())]; };
  std::uint32_t seed = draw();
  if (random.below(2) == 0) return seed;
  for (int n = 1; n < kDraws; ++n) {
    const std::uint32_t other = draw();
    if (blame(other) > blame(seed)) seed = other;
  }
  return seed;
}

void NeighbourhoodSearch::free_arc(ArcId a) {
  freed_.push_back(a);
  for (const std::uint32_t slot : arc_slots_[a]) {
    if (is_freed_[slot] == 0) freed_slots_.push_back(slot);
    is_freed_[slot] = 1;
  }
}

void NeighbourhoodSearch::free_around(std::uint32_t seed, std::size_t count, core::Random& random) {
  for (const std::uint32_t slot : freed_slots_) is_freed_[slot] = 0;
  freed_.clear();
  freed_slots_ = {seed};
  is_freed_[seed] = 1;
  if (state_.owner(seed) != kNoArc) free_arc(state_.owner(seed));
  for (std::size_t step = 0; freed_.size() < count && step < kStepsPerArc * count; ++step) {
    const std::span<const ArcId> arcs = slot_arcs_[freed_slots_[random.below(freed_slots_.size())]];
    if (arcs.empty()) continue;
    const ArcId a = arcs[random.below(std::min<std::uint64_t>(kChoices, arcs.size()))];
    for (const std::uint32_t slot : arc_slots_[a]) {
      const ArcId owner = state_.owner(slot);
      if (owner != kNoArc && is_freed_[slot] == 0) free_arc(owner);
    }
  }
}

bool NeighbourhoodSearch::is_free(std::uint32_t slot) const {
  return is_freed_[slot] != 0 || state_.owner(slot) == kNoArc;
}

bool NeighbourhoodSearch::fits(ArcId a) const {
  const std::span<const std::uint32_t> slots = arc_slots_[a];
  return std::all_of(slots.begin(), slots.end(), [&](std::uint32_t slot) { return is_free(slot); });
}

// Arcs that fit into what was freed.
std::vector<ArcId> NeighbourhoodSearch::candidates(ArcId without) {
  std::vector<ArcId> arcs;
  looked_at_ = 0;
  for (const std::uint32_t slot : freed_slots_) {
    for (const ArcId a : slot_arcs_[slot]) {
      ++looked_at_;
      if (listed_[a] != 0 || a == without || !fits(a)) continue;
      listed_[a] = 1;
      arcs.push_back(a);
    }
  }
  for (const ArcId a : arcs) listed_[a] = 0;
  return arcs;
}

std::uint32_t NeighbourhoodSearch::row_of(std::uint32_t slot) {
  if (row_[slot] == kNoRow) {
    row_[slot] = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back(slot);
  }
  return row_[slot];
}

// What the freed arcs, and the uncovered rows in their reach, cost beyond the multipliers.
double NeighbourhoodSearch::slack_of_freed() const {
  double slack = 0;
  for (const ArcId a : freed_) slack += reduced_[a];
  for (const std::uint32_t slot : rows_) {
    if (state_.owner(slot) == kNoArc) slack += price_[slot];
  }
  return slack;
}

NeighbourhoodSearch::Attempt NeighbourhoodSearch::refill(ArcId without,
                                                         double allowed_rise,
                                                         const core::Deadline& deadline) {
  const std::vector<ArcId> arcs = candidates(without);
  std::vector<bnb::RowUse> uses;
  rows_.clear();
  for (const std::uint32_t slot : freed_slots_) row_of(slot);
  for (const ArcId a : arcs) {
    for (const std::uint32_t slot : arc_slots_[a]) row_of(slot);
  }
  bnb::SlackProblem problem(static_cast<std::uint32_t>(rows_.size()));
  for (const std::uint32_t slot : rows_) problem.add_row(price_[slot]);
  for (const ArcId a : arcs) {
    uses.clear();
    for (const std::uint32_t slot : arc_slots_[a]) uses.push_back({row_[slot], 1});
    problem.add_arc(reduced_[a], uses);
  }
  const double budget = slack_of_freed() * (1 - kBetter) + allowed_rise;
  for (const std::uint32_t slot : rows_) row_[slot] = kNoRow;
  bnb::SlackLimits limits;
  limits.max_work = kWorkPerAttempt;
  limits.deadline = deadline;
  const bnb::SlackResult result = bnb::search_slack(problem, budget, limits);
  if (result.slack < budget) {
    for (const ArcId a : freed_) state_.remove(a);
    for (const std::uint32_t n : result.arcs) state_.insert(arcs[n]);
  }
  return {result.complete, result.work};
}

}  // namespace nda::recovery
