#include "cutting/leaf_search.hpp"

#include <algorithm>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/double_double.hpp"

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;

constexpr std::uint32_t kNone = ~std::uint32_t{0};
constexpr double kShrunk = 0.75;
constexpr double kFirstShare = 0.125;  // of the gap

// A solved master in the terms of the search.
class Translation {
 public:
  Translation(const Component& component, const Master& master)
      : component_(component), master_(master), u_(master.u().begin(), master.u().end()) {
    make_feasible();
  }

  double base() const { return base_; }
  std::span<const double> u() const { return u_; }

  /// The arcs that the budget pays for, and the search among them.
  std::vector<ArcId> affordable(double budget) const {
    std::vector<ArcId> arcs;
    for (const ArcId a : master_.live()) {
      if (is_allowed(a) && reduced(a) < budget) arcs.push_back(a);
    }
    return arcs;
  }

  bnb::SlackProblem problem(const std::vector<ArcId>& arcs) const {
    bnb::SlackProblem problem(static_cast<std::uint32_t>(component_.num_slots()));
    for (std::uint32_t slot = 0; slot < u_.size(); ++slot)
      problem.add_row(master_.forced(slot) ? kInfinity : std::max(0.0, -u_[slot]));
    const std::vector<std::vector<bnb::RowUse>> of_cuts = add_cuts(arcs, problem);
    std::vector<bnb::RowUse> uses;
    for (std::size_t n = 0; n < arcs.size(); ++n) {
      uses.clear();
      core::for_each_slot(component_, arcs[n], [&](std::uint32_t slot) {
        uses.push_back({slot, 1});
      });
      uses.insert(uses.end(), of_cuts[n].begin(), of_cuts[n].end());
      problem.add_arc(std::max(0.0, reduced(arcs[n])), uses);
    }
    return problem;
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

  // A row for every cut that has a price; returns its uses by arc.
  std::vector<std::vector<bnb::RowUse>> add_cuts(const std::vector<ArcId>& arcs,
                                                 bnb::SlackProblem& problem) const {
    std::vector<std::vector<bnb::RowUse>> of_cuts(arcs.size());
    std::vector<std::uint32_t> number(component_.num_arcs(), kNone);
    for (std::uint32_t n = 0; n < arcs.size(); ++n) number[arcs[n]] = n;
    for (const CutRow& row : master_.cuts()) {
      if (row.multiplier == 0) continue;
      const std::uint32_t cut =
          problem.add_row(-row.multiplier, static_cast<std::uint32_t>(row.cut.right_side()));
      for (const CutEntry& entry : row.entries) {
        if (number[entry.arc] != kNone)
          of_cuts[number[entry.arc]].push_back(
              {cut, static_cast<std::uint32_t>(entry.coefficient)});
      }
    }
    return of_cuts;
  }

  const Component& component_;
  const Master& master_;
  std::vector<double> u_;
  double base_ = 0;
};

}  // namespace

bool LeafSearch::is_worth_trying(const Master& master, double cutoff) const {
  if (limits_.max_work == 0 || master.live().size() > kMostLeafArcs) return false;
  const double gap = cutoff - master.lower();
  return gap <= kShrunk * failed_gap_ ||
         master.lower() - failed_lower_ >= (1 - kShrunk) * failed_budget_ ||
         credit_ >= 2 * failed_work_;
}

bool LeafSearch::operator()(const Master& master, double& cutoff) {
  credit_ += limits_.max_work +
             work_of_pivots(master.simplex_iterations() - pivots_, component_.num_slots());
  pivots_ = master.simplex_iterations();
  if (!is_worth_trying(master, cutoff) || limits_.deadline.reached()) return false;
  const Translation translation(component_, master);
  const double gap = cutoff - translation.base();
  bnb::SlackLimits limits;
  limits.deadline = limits_.deadline;
  double budget = kFirstShare * gap > 0 ? kFirstShare * gap : gap;
  for (double work = 0;; budget *= 2) {
    budget = std::min(gap, budget);
    limits.max_work = credit_ - work;
    limits.max_nodes = limits_.max_nodes - nodes_;
    const std::vector<ArcId> arcs = translation.affordable(budget);
    const bnb::SlackResult result = bnb::search_slack(translation.problem(arcs), budget, limits);
    nodes_ += result.nodes;
    work += result.work;
    if (result.slack < kInfinity) {
      std::vector<ArcId> chosen;
      for (const std::uint32_t n : result.arcs) chosen.push_back(arcs[n]);
      const core::Packing packing = core::make_packing(component_, std::move(chosen));
      if (packing.cost < cutoff) cutoff = offer_(master, &packing);
    }
    if (!result.complete) break;
    if (!(result.slack < budget) && budget < gap) continue;
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
