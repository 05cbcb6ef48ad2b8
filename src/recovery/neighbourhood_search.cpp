#include "recovery/neighbourhood_search.hpp"

#include <algorithm>

// Neighbourhoods grow along arcs that might replace what is there: from a freed index over one of
// its cheap arcs to the owners of that arc's other indices.  Half of them start where the packing
// loses most against the multipliers (the reduced cost of the owner, the price of an uncovered
// index), the others anywhere.  Their size follows what the subproblem solver can finish: it grows
// while searches are complete, fast at first, and shrinks when they are not (adaptive as in
// Pisinger & Ropke 2010).
//
// Cuts take part: what the arcs that stay leave of a cut's capacity is its capacity in the
// subproblem.  After many rounds of cuts the slack of a good packing is a third of what the
// indices' multipliers alone would call slack, and neighbourhoods of twice the size can be seen
// through.

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = SlackPacking::kNone;
constexpr double kFirstSize = 4;
constexpr double kLeastSize = 2;
constexpr double kFirstGrowth = 1;  // until the first search that is not complete
constexpr double kGrowth = 0.05;
constexpr double kShrinking = 0.5;
constexpr double kWorkPerAttempt = 3e5;    // a millisecond
constexpr double kWorkOfSettingUp = 5000;  // even where nothing is looked at
constexpr std::uint64_t kChoices = 12;     // cheap arcs of an index
constexpr std::size_t kStepsPerArc = 20;
constexpr double kBetter = 1e-9;
constexpr std::uint64_t kAttemptsPerDetour = 4;
// Shares of the gap: what a detour may cost, and how far they may lead from the best packing.
constexpr double kDetour = 0.1;
constexpr double kFarthest = 0.3;

}  // namespace

NeighbourhoodSearch::NeighbourhoodSearch(const bnb::SlackProblem& problem)
    : problem_(problem),
      state_(problem),
      is_freed_(problem.num_indices(), 0),
      row_(problem.num_rows(), kNone),
      taken_(problem.num_rows(), 0),
      listed_(problem.num_arcs(), 0) {
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
  }
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
  while (work < limits.max_work && best_slack > limits.goal && !limits.deadline.reached()) {
    free_around(choose_seed(random), static_cast<std::size_t>(size), random);
    const double gap = best_slack - std::max(0.0, limits.goal);
    const bool detour = !freed_.empty() && random.below(kAttemptsPerDetour) == 0;
    const Attempt attempt =
        detour
            ? refill(freed_[random.below(freed_.size())], random.uniform(0, kDetour) * gap, limits)
            : refill(kNone, 0, limits);
    work += attempt.work + kWorkOfSettingUp + static_cast<double>(looked_at_);
    if (!attempt.complete) growth = kGrowth;
    size = attempt.complete ? size + growth : std::max(kLeastSize, size - kShrinking);
    if (state_.slack() < best_slack * (1 - kBetter)) {
      best = state_.arcs();
      best_slack = state_.slack();
    } else if (state_.slack() > best_slack + kFarthest * gap) {
      state_.assign(best);
    }
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

void NeighbourhoodSearch::free_arc(std::uint32_t arc) {
  freed_.push_back(arc);
  for (const bnb::RowUse& use : problem_.index_uses(arc)) {
    if (is_freed_[use.row] == 0) freed_indices_.push_back(use.row);
    is_freed_[use.row] = 1;
  }
}

void NeighbourhoodSearch::free_around(std::uint32_t seed, std::size_t count, core::Random& random) {
  for (const std::uint32_t index : freed_indices_) is_freed_[index] = 0;
  freed_.clear();
  freed_indices_ = {seed};
  is_freed_[seed] = 1;
  if (state_.owner(seed) != kNone) free_arc(state_.owner(seed));
  for (std::size_t step = 0; freed_.size() < count && step < kStepsPerArc * count; ++step) {
    const std::span<const std::uint32_t> arcs =
        arcs_of(freed_indices_[random.below(freed_indices_.size())]);
    if (arcs.empty()) continue;
    const std::uint32_t arc = arcs[random.below(std::min<std::uint64_t>(kChoices, arcs.size()))];
    for (const bnb::RowUse& use : problem_.index_uses(arc)) {
      if (state_.owner(use.row) != kNone && is_freed_[use.row] == 0)
        free_arc(state_.owner(use.row));
    }
  }
}

bool NeighbourhoodSearch::fits(std::uint32_t arc) const {
  for (const bnb::RowUse& use : problem_.index_uses(arc)) {
    if (is_freed_[use.row] == 0 && state_.owner(use.row) != kNone) return false;
  }
  return true;
}

// Arcs that fit into what was freed.
std::vector<std::uint32_t> NeighbourhoodSearch::candidates(std::uint32_t without,
                                                           double most_reduced) {
  std::vector<std::uint32_t> arcs;
  looked_at_ = 0;
  for (const std::uint32_t index : freed_indices_) {
    for (const std::uint32_t arc : arcs_of(index)) {
      ++looked_at_;
      if (problem_.reduced(arc) > most_reduced) break;
      if (listed_[arc] != 0 || arc == without || !fits(arc)) continue;
      listed_[arc] = 1;
      arcs.push_back(arc);
    }
  }
  for (const std::uint32_t arc : arcs) listed_[arc] = 0;
  return arcs;
}

// The rows that freed arcs and candidates use, indices first.
void NeighbourhoodSearch::list_rows(const std::vector<std::uint32_t>& arcs) {
  rows_.clear();
  const auto add = [&](std::uint32_t row) {
    if (row_[row] != kNone) return;
    row_[row] = 0;
    rows_.push_back(row);
  };
  for (const std::uint32_t index : freed_indices_) add(index);
  const auto add_rows_of = [&](std::span<const std::uint32_t> list) {
    for (const std::uint32_t arc : list) {
      for (const bnb::RowUse& use : problem_.uses(arc)) add(use.row);
    }
  };
  add_rows_of(freed_);
  add_rows_of(arcs);
  std::stable_partition(
      rows_.begin(), rows_.end(), [&](std::uint32_t row) { return state_.is_index(row); });
  for (std::uint32_t n = 0; n < rows_.size(); ++n) row_[rows_[n]] = n;
}

bnb::SlackProblem NeighbourhoodSearch::subproblem(const std::vector<std::uint32_t>& arcs) {
  list_rows(arcs);
  for (const std::uint32_t arc : freed_) {
    for (const bnb::RowUse& use : problem_.uses(arc)) taken_[use.row] += use.coefficient;
  }
  const auto num_indices = std::count_if(
      rows_.begin(), rows_.end(), [&](std::uint32_t row) { return state_.is_index(row); });
  bnb::SlackProblem part(static_cast<std::uint32_t>(num_indices));
  for (const std::uint32_t row : rows_) {
    part.add_row(problem_.price(row), state_.left(row) + taken_[row]);
    taken_[row] = 0;
  }
  std::vector<bnb::RowUse> uses;
  for (const std::uint32_t arc : arcs) {
    uses.clear();
    for (const bnb::RowUse& use : problem_.uses(arc))
      uses.push_back({row_[use.row], use.coefficient});
    part.add_arc(problem_.reduced(arc), uses);
  }
  for (const std::uint32_t row : rows_) row_[row] = kNone;
  return part;
}

// What the freed arcs, and what they leave of the rows in reach, cost beyond the multipliers.
double NeighbourhoodSearch::slack_of_freed() const {
  double slack = 0;
  for (const std::uint32_t arc : freed_) slack += problem_.reduced(arc);
  for (const std::uint32_t row : rows_) slack += state_.unused(row);
  return slack;
}

NeighbourhoodSearch::Attempt NeighbourhoodSearch::refill(std::uint32_t without,
                                                         double allowed_rise,
                                                         const Limits& limits) {
  const std::vector<std::uint32_t> arcs = candidates(without, limits.most_reduced);
  const bnb::SlackProblem part = subproblem(arcs);
  const double budget = slack_of_freed() * (1 - kBetter) + allowed_rise;
  bnb::SlackLimits search;
  search.max_work = kWorkPerAttempt;
  search.deadline = limits.deadline;
  const bnb::SlackResult result = bnb::search_slack(part, budget, search);
  if (result.slack < budget) {
    for (const std::uint32_t arc : freed_) state_.remove(arc);
    for (const std::uint32_t n : result.arcs) state_.insert(arcs[n]);
  }
  return {result.complete, result.work};
}

}  // namespace nda::recovery
