#include "kbest/nearby_packings.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "kbest/combinations.hpp"
#include "kbest/slack_ranking.hpp"

// Large-neighbourhood search for k packings: some arcs of a known one are freed, close to each
// other, and all that fits in their place is ranked within what the rest leaves of the budget.  As
// many are freed as its search can see through.  Any of the packings within the budget may be the
// base, so what differs in several places comes together.
//
// Source of the idea: Shaw (1998, "Using constraint programming and local search methods to solve
// vehicle routing problems"), where only a better solution counts.

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr ArcId kNone = ~ArcId{0};
constexpr std::uint32_t kUnnumbered = ~std::uint32_t{0};
constexpr double kWorkAtATime = 2e4;
constexpr double kPatience = 0.25;  // share of the work without a find
constexpr std::size_t kWorkPerRow = 4;
constexpr std::size_t kWorkPerArc = 20;
constexpr std::size_t kFewestFreed = 2;
constexpr std::size_t kTriesPerFreed = 8;

}  // namespace

double slack_of_packing(const bnb::SlackProblem& problem, const std::vector<ArcId>& arcs) {
  std::vector<bool> is_used(problem.num_rows(), false);
  double slack = 0;
  for (const ArcId a : arcs) {
    slack += problem.reduced(a);
    for (const bnb::RowUse use : problem.uses(a)) is_used[use.row] = true;
  }
  for (std::uint32_t row = 0; row < problem.num_rows(); ++row) {
    if (!is_used[row]) slack += problem.price(row);
  }
  return slack;
}

NearbyPackings::NearbyPackings(const bnb::SlackProblem& problem)
    : problem_(problem),
      arcs_of_(problem.num_rows(),
               [&](auto&& visit) {
                 for (ArcId a = 0; a < problem.num_arcs(); ++a) {
                   for (const bnb::RowUse use : problem.uses(a)) visit(use.row, a);
                 }
               }),
      owner_(problem.num_rows(), kNone),
      number_(problem.num_rows(), kUnnumbered) {}

std::int64_t NearbyPackings::search(PackingBuffer& known,
                                    double budget,
                                    double goal,
                                    const bnb::SlackLimits& limits) {
  left_ = limits;
  nodes_ = 0;
  double at_find = left_.max_work;
  while (known.cutoff() > goal && left_.max_work > at_find - kPatience * limits.max_work) {
    if (left_.max_work <= 0 || left_.max_nodes <= 0 || left_.deadline.reached()) break;
    const auto& all = known.packings();
    const auto near = std::ranges::lower_bound(all, budget, {}, &PackingBuffer::Kept::cost);
    const auto num_near = std::max<std::ptrdiff_t>(1, near - all.begin());
    const PackingBuffer::Kept& base = all[random_.below(static_cast<std::uint64_t>(num_near))];
    if (look_around({*base.arcs, base.cost}, std::min(budget, known.cutoff()), known))
      at_find = left_.max_work;
  }
  return nodes_;
}

// Returns whether something new was found.
bool NearbyPackings::look_around(const core::Packing& base, double limit, PackingBuffer& known) {
  std::fill(owner_.begin(), owner_.end(), kNone);
  for (const ArcId a : base.arcs) {
    for (const bnb::RowUse use : problem_.uses(a)) owner_[use.row] = a;
  }
  free_some(base.arcs);
  find_fitting(limit);
  number_rows();
  const double budget = limit - (base.cost - freed_slack());
  bnb::SlackLimits search = left_;
  search.max_work = std::min(left_.max_work, kWorkAtATime);
  Combinations combinations;
  SlackRanking found;
  if (budget > 0)
    found = rank_slack(freed_problem(), budget, known.capacity(), search, fitting_, combinations);
  for (const std::uint32_t row : rows_) number_[row] = kUnnumbered;
  left_.max_work -= found.work + static_cast<double>(kWorkPerArc * fitting_.size()) +
                    static_cast<double>((kWorkPerRow + found.packings.size()) * owner_.size());
  left_.max_nodes -= found.nodes;
  nodes_ += found.nodes;
  num_freed_ = found.complete || !(budget > 0) ? std::min(num_freed_ + 1, base.arcs.size())
                                               : std::max(kFewestFreed, num_freed_ - 1);
  bool is_new = false;
  for (const Ranked& ranked : found.packings) {
    if (left_.deadline.reached()) break;
    core::Packing packing = completed(base, combinations.arcs(ranked.arcs));
    is_new = (packing.cost < limit && known.add(std::move(packing))) || is_new;
  }
  return is_new;
}

// Some arcs of a packing, from one of them on to what shares rows with what could be used there.
void NearbyPackings::free_some(const std::vector<ArcId>& packing) {
  touched_.clear();
  freed_.clear();
  if (packing.empty()) {
    for (std::uint32_t row = 0; row < problem_.num_rows(); ++row) touched_.push_back(row);
    return;
  }
  free(packing[random_.below(packing.size())]);
  const std::size_t wanted = std::min(num_freed_, packing.size());
  for (std::size_t n = 0; freed_.size() < wanted && n < kTriesPerFreed * wanted; ++n) {
    const auto arcs = arcs_of_[touched_[random_.below(touched_.size())]];
    if (arcs.empty()) continue;
    for (const bnb::RowUse use : problem_.uses(arcs[random_.below(arcs.size())])) {
      if (owner_[use.row] != kNone && freed_.size() < wanted) free(owner_[use.row]);
      if (owner_[use.row] == kNone && std::ranges::find(touched_, use.row) == touched_.end())
        touched_.push_back(use.row);
    }
  }
}

void NearbyPackings::free(ArcId arc) {
  freed_.push_back(arc);
  for (const bnb::RowUse use : problem_.uses(arc)) {
    owner_[use.row] = kNone;
    touched_.push_back(use.row);
  }
}

// What may be used in their place.
void NearbyPackings::find_fitting(double limit) {
  fitting_.clear();
  const auto is_kept = [&](const bnb::RowUse& use) { return owner_[use.row] != kNone; };
  for (const std::uint32_t row : touched_) {
    for (const ArcId a : arcs_of_[row]) {
      if (problem_.reduced(a) < limit && std::ranges::none_of(problem_.uses(a), is_kept))
        fitting_.push_back(a);
    }
  }
  std::sort(fitting_.begin(), fitting_.end());
  fitting_.erase(std::unique(fitting_.begin(), fitting_.end()), fitting_.end());
}

void NearbyPackings::number_rows() {
  rows_.clear();
  const auto number = [&](std::uint32_t row) {
    if (number_[row] != kUnnumbered) return;
    number_[row] = static_cast<std::uint32_t>(rows_.size());
    rows_.push_back(row);
  };
  for (const std::uint32_t row : touched_) number(row);
  for (const ArcId a : fitting_) {
    for (const bnb::RowUse use : problem_.uses(a)) number(use.row);
  }
}

// The slack that the packing has there.
double NearbyPackings::freed_slack() const {
  std::vector<bool> is_used(rows_.size(), false);
  double slack = 0;
  for (const ArcId a : freed_) {
    slack += problem_.reduced(a);
    for (const bnb::RowUse use : problem_.uses(a)) is_used[number_[use.row]] = true;
  }
  for (std::size_t n = 0; n < rows_.size(); ++n) {
    if (!is_used[n]) slack += problem_.price(rows_[n]);
  }
  return slack;
}

bnb::SlackProblem NearbyPackings::freed_problem() const {
  bnb::SlackProblem problem(static_cast<std::uint32_t>(rows_.size()));
  for (const std::uint32_t row : rows_) problem.add_row(problem_.price(row));
  std::vector<bnb::RowUse> uses;
  for (const ArcId a : fitting_) {
    uses.clear();
    for (const bnb::RowUse use : problem_.uses(a)) uses.push_back({number_[use.row], 1});
    problem.add_arc(problem_.reduced(a), uses);
  }
  return problem;
}

// What is kept of a packing, and other arcs instead of what was freed.
core::Packing NearbyPackings::completed(const core::Packing& base,
                                        const std::vector<ArcId>& arcs) const {
  core::Packing packing{arcs, 0};
  std::ranges::copy_if(base.arcs, std::back_inserter(packing.arcs), [&](ArcId a) {
    return owner_[problem_.uses(a).front().row] == a;
  });
  std::sort(packing.arcs.begin(), packing.arcs.end());
  packing.cost = slack_of_packing(problem_, packing.arcs);
  return packing;
}

}  // namespace nda::kbest
