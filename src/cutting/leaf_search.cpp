#include "cutting/leaf_search.hpp"

#include <algorithm>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/double_double.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;

constexpr double kShrunk = 0.75;
// A pivot of the simplex method takes as long as looking at so many arcs for every row.
constexpr double kArcsPerPivotAndRow = 0.5;
constexpr double kFirstShare = 0.125;  // of the gap

// What a search needs to know of a solved master.
class Translation {
 public:
  Translation(const Component& component, const Master& master, double cutoff)
      : component_(component), master_(master), u_(master.u().begin(), master.u().end()) {
    make_feasible();
    for (const ArcId a : master.live()) {
      if (is_allowed(a) && base_ + reduced(a) < cutoff) arcs_.push_back(a);
    }
    add_rows();
  }

  double base() const { return base_; }
  std::span<const double> u() const { return u_; }
  const std::vector<ArcId>& arcs() const { return arcs_; }

  bnb::SlackProblem problem() && {
    std::vector<bnb::RowUse> uses;
    for (const ArcId a : arcs_) {
      uses.clear();
      core::for_each_slot(component_, a, [&](std::uint32_t slot) { uses.push_back({slot, 1}); });
      uses.insert(uses.end(), of_cuts_[a].begin(), of_cuts_[a].end());
      problem_.add_arc(std::max(0.0, reduced(a)), uses);
    }
    return std::move(problem_);
  }

 private:
  bool is_allowed(ArcId a) const { return !master_.forbidden(a); }

  // What the multipliers changed since the master was solved changes its reduced costs.
  double reduced(ArcId a) const {
    double r = master_.reduced_cost(a);
    core::for_each_slot(
        component_, a, [&](std::uint32_t slot) { r += master_.u()[slot] - u_[slot]; });
    return r;
  }

  // Slack is cost but for a constant only if no reduced cost is negative.  The simplex method
  // leaves some within its tolerance.
  void make_feasible() {
    core::DoubleDouble base(master_.lower());
    for (const ArcId a : master_.live()) {
      if (is_allowed(a) && master_.reduced_cost(a) < 0) base.add(-master_.reduced_cost(a));
    }
    for (const ArcId a : master_.live()) {
      if (!is_allowed(a) || master_.reduced_cost(a) >= 0) continue;
      const double r = reduced(a);
      if (r >= 0) continue;
      std::uint32_t last = 0;
      core::for_each_slot(component_, a, [&](std::uint32_t slot) { last = slot; });
      base.add(r);
      u_[last] += r;
    }
    base_ = base.high();
  }

  void add_rows() {
    for (std::uint32_t slot = 0; slot < u_.size(); ++slot)
      problem_.add_row(master_.forced(slot) ? kInfinity : std::max(0.0, -u_[slot]));
    for (const CutRow& row : master_.cuts()) {
      if (row.multiplier == 0) continue;
      const std::uint32_t number =
          problem_.add_row(-row.multiplier, static_cast<std::uint32_t>(row.cut.right_side()));
      for (const CutEntry& entry : row.entries)
        of_cuts_[entry.arc].push_back({number, static_cast<std::uint32_t>(entry.coefficient)});
    }
  }

  const Component& component_;
  const Master& master_;
  std::vector<double> u_;
  double base_ = 0;
  std::vector<ArcId> arcs_;
  std::vector<std::vector<bnb::RowUse>> of_cuts_{component_.num_arcs()};
  bnb::SlackProblem problem_{static_cast<std::uint32_t>(component_.num_slots())};
};

core::Packing packing_of(const Component& component,
                         const std::vector<ArcId>& arcs,
                         const std::vector<std::uint32_t>& chosen) {
  core::Packing packing;
  for (const std::uint32_t n : chosen) packing.arcs.push_back(arcs[n]);
  std::sort(packing.arcs.begin(), packing.arcs.end());
  for (const ArcId a : packing.arcs) packing.cost += component.costs[a];
  return packing;
}

}  // namespace

bool LeafSearch::is_worth_trying(const Master& master, double cutoff) const {
  if (limits_.max_work == 0 || master.live().size() > kMostLeafArcs) return false;
  const double gap = cutoff - master.lower();
  return gap <= kShrunk * failed_gap_ ||
         master.lower() - failed_lower_ >= (1 - kShrunk) * failed_budget_ ||
         credit_ >= 2 * failed_work_;
}

bool LeafSearch::operator()(const Master& master, double& cutoff) {
  credit_ += limits_.max_work + kArcsPerPivotAndRow *
                                    static_cast<double>(master.simplex_iterations() - pivots_) *
                                    static_cast<double>(component_.num_slots());
  pivots_ = master.simplex_iterations();
  if (!is_worth_trying(master, cutoff)) return false;
  Translation translation(component_, master, cutoff);
  const bnb::SlackProblem problem = std::move(translation).problem();
  const double gap = cutoff - translation.base();
  bnb::SlackLimits limits;
  limits.deadline = limits_.deadline;
  double budget = kFirstShare * gap;
  for (double work = 0;; budget *= 2) {
    budget = std::min(gap, budget);
    limits.max_work = credit_ - work;
    limits.max_nodes = limits_.max_nodes - nodes_;
    const bnb::SlackResult result = bnb::search_slack(problem, budget, limits);
    nodes_ += result.nodes;
    work += result.work;
    if (result.slack < kInfinity) {
      const core::Packing packing = packing_of(component_, translation.arcs(), result.arcs);
      if (packing.cost < cutoff) cutoff = offer_(master, &packing);
    }
    if (!result.complete) break;
    if (result.slack == kInfinity && budget < gap) continue;
    if (limits_.proof != nullptr) limits_.proof->search(master, translation.u(), cutoff);
    return true;
  }
  failed_gap_ = gap;
  failed_budget_ = budget;
  failed_lower_ = master.lower();
  failed_work_ = credit_;
  credit_ = 0;
  return false;
}

}  // namespace nda::cutting
