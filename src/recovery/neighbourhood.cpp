#include "recovery/neighbourhood.hpp"

#include <algorithm>
#include <span>

#include "core/component.hpp"

// Neighbourhoods grow along arcs that might replace what is there: from a freed index over one of
// its cheap arcs to the owners of that arc's other indices.
//
// Cuts take part: what the arcs that stay leave of a cut's capacity is its capacity in the
// subproblem.  After many rounds of cuts the slack of a good packing is a third of what the
// indices' multipliers alone would call slack, and neighbourhoods of twice the size can be seen
// through.

namespace nda::recovery {
namespace {

constexpr std::uint32_t kNone = SlackPacking::kNone;
constexpr double kWorkOfSettingUp = 5000;  // even where nothing is looked at
constexpr std::uint64_t kChoices = 12;     // cheap arcs of an index
constexpr std::size_t kStepsPerArc = 20;
constexpr double kBetter = 1e-9;
constexpr std::uint64_t kAttemptsPerDetour = 4;

}  // namespace

Neighbourhood::Neighbourhood(const bnb::SlackProblem& problem,
                             const core::Lists<std::uint32_t>& arcs,
                             const SlackPacking& packing)
    : problem_(problem),
      arcs_(arcs),
      packing_(packing),
      is_freed_(problem.num_indices(), 0),
      row_(problem.num_rows(), kNone),
      taken_(problem.num_rows(), 0),
      listed_(problem.num_arcs(), 0) {}

void Neighbourhood::choose(std::uint32_t seed,
                           std::size_t size,
                           double most_rise,
                           core::Random& random) {
  for (const std::uint32_t index : freed_indices_) is_freed_[index] = 0;
  freed_.clear();
  freed_indices_ = {seed};
  is_freed_[seed] = 1;
  if (packing_.owner(seed) != kNone) free_arc(packing_.owner(seed));
  for (std::size_t step = 0; freed_.size() < size && step < kStepsPerArc * size; ++step) {
    const std::span<const std::uint32_t> arcs =
        arcs_[freed_indices_[random.below(freed_indices_.size())]];
    if (arcs.empty()) continue;
    const std::uint32_t arc = arcs[random.below(std::min<std::uint64_t>(kChoices, arcs.size()))];
    for (const bnb::RowUse& use : problem_.index_uses(arc)) {
      if (packing_.owner(use.row) != kNone && is_freed_[use.row] == 0)
        free_arc(packing_.owner(use.row));
    }
  }
  const bool is_detour = !freed_.empty() && random.below(kAttemptsPerDetour) == 0;
  without_ = is_detour ? freed_[random.below(freed_.size())] : kNone;
  allowed_rise_ = is_detour ? random.uniform(0, most_rise) : 0;
}

void Neighbourhood::free_arc(std::uint32_t arc) {
  freed_.push_back(arc);
  for (const bnb::RowUse& use : problem_.index_uses(arc)) {
    if (is_freed_[use.row] == 0) freed_indices_.push_back(use.row);
    is_freed_[use.row] = 1;
  }
}

void Neighbourhood::search(double most_reduced, const bnb::SlackLimits& limits) {
  work_ = kWorkOfSettingUp;
  list_candidates(most_reduced);
  const bnb::SlackProblem part = subproblem();
  best_ = bnb::search_slack(part, slack_of_freed() * (1 - kBetter) + allowed_rise_, limits);
  work_ += best_.work;
}

bool Neighbourhood::fits(std::uint32_t arc) const {
  for (const bnb::RowUse& use : problem_.index_uses(arc)) {
    if (is_freed_[use.row] == 0 && packing_.owner(use.row) != kNone) return false;
  }
  return true;
}

// Arcs that fit into what was freed.
void Neighbourhood::list_candidates(double most_reduced) {
  candidates_.clear();
  for (const std::uint32_t index : freed_indices_) {
    for (const std::uint32_t arc : arcs_[index]) {
      ++work_;
      if (problem_.reduced(arc) > most_reduced) break;
      if (listed_[arc] != 0 || arc == without_ || !fits(arc)) continue;
      listed_[arc] = 1;
      candidates_.push_back(arc);
    }
  }
  for (const std::uint32_t arc : candidates_) listed_[arc] = 0;
}

// The rows that freed arcs and candidates use, indices first.
void Neighbourhood::list_rows() {
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
  add_rows_of(candidates_);
  std::stable_partition(
      rows_.begin(), rows_.end(), [&](std::uint32_t row) { return packing_.is_index(row); });
  for (std::uint32_t n = 0; n < rows_.size(); ++n) row_[rows_[n]] = n;
}

bnb::SlackProblem Neighbourhood::subproblem() {
  list_rows();
  for (const std::uint32_t arc : freed_) {
    for (const bnb::RowUse& use : problem_.uses(arc)) taken_[use.row] += use.coefficient;
  }
  const auto num_indices = std::count_if(
      rows_.begin(), rows_.end(), [&](std::uint32_t row) { return packing_.is_index(row); });
  bnb::SlackProblem part(static_cast<std::uint32_t>(num_indices));
  for (const std::uint32_t row : rows_) {
    part.add_row(problem_.price(row), packing_.left(row) + taken_[row]);
    taken_[row] = 0;
  }
  std::vector<bnb::RowUse> uses;
  for (const std::uint32_t arc : candidates_) {
    uses.clear();
    for (const bnb::RowUse& use : problem_.uses(arc))
      uses.push_back({row_[use.row], use.coefficient});
    part.add_arc(problem_.reduced(arc), uses);
  }
  for (const std::uint32_t row : rows_) row_[row] = kNone;
  return part;
}

// What the freed arcs, and what they leave of the rows in reach, cost beyond the multipliers.
double Neighbourhood::slack_of_freed() const {
  double slack = 0;
  for (const std::uint32_t arc : freed_) slack += problem_.reduced(arc);
  for (const std::uint32_t row : rows_) slack += packing_.unused(row);
  return slack;
}

// All that was taken out is still there.
bool Neighbourhood::is_current() const {
  return std::all_of(freed_.begin(), freed_.end(), [&](std::uint32_t arc) {
    return packing_.owner(problem_.index_uses(arc).front().row) == arc;
  });
}

bool Neighbourhood::fill(SlackPacking& packing) const {
  if (!is_current()) return false;
  const double before = packing.slack();
  for (const std::uint32_t arc : freed_) packing.remove(arc);
  std::vector<std::uint32_t> filled = core::at_positions(candidates_, best_.arcs);
  const bool fit =
      std::all_of(filled.begin(), filled.end(), [&](auto arc) { return packing.fits(arc); });
  if (!fit) filled.clear();
  for (const std::uint32_t arc : filled) packing.insert(arc);
  // Others may have used up what was left of a cut.
  if (fit && packing.slack() <= before + allowed_rise_) return true;
  for (const std::uint32_t arc : filled) packing.remove(arc);
  for (const std::uint32_t arc : freed_) packing.insert(arc);
  return false;
}

}  // namespace nda::recovery
