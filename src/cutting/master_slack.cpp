#include "cutting/master_slack.hpp"

#include <algorithm>

#include "core/double_double.hpp"

namespace nda::cutting {

using core::ArcId;

MasterSlack::MasterSlack(const core::Component& component, const Master& master)
    : component_(component), master_(master), u_(master.u().begin(), master.u().end()) {
  make_feasible();
}

std::vector<ArcId> MasterSlack::affordable(double budget) const {
  std::vector<ArcId> arcs;
  for (const ArcId a : master_.live()) {
    if (!master_.forbidden(a) && reduced(a) < budget) arcs.push_back(a);
  }
  return arcs;
}

bnb::SlackProblem MasterSlack::problem(const std::vector<ArcId>& arcs) const {
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

// What the multipliers changed since the master was solved changes its reduced costs.
double MasterSlack::reduced(ArcId a) const {
  double r = master_.reduced_cost(a);
  core::for_each_slot(
      component_, a, [&](std::uint32_t slot) { r += master_.u()[slot] - u_[slot]; });
  return r;
}

void MasterSlack::make_feasible() {
  core::DoubleDouble base(master_.lower());
  for (const ArcId a : master_.live()) {
    if (!master_.forbidden(a) && master_.reduced_cost(a) < 0) base.add(-master_.reduced_cost(a));
  }
  for (const ArcId a : master_.live()) {
    if (master_.forbidden(a) || master_.reduced_cost(a) >= 0) continue;
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
std::vector<std::vector<bnb::RowUse>> MasterSlack::add_cuts(const std::vector<ArcId>& arcs,
                                                            bnb::SlackProblem& problem) const {
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::vector<bnb::RowUse>> of_cuts(arcs.size());
  std::vector<std::uint32_t> number(component_.num_arcs(), kNone);
  for (std::uint32_t n = 0; n < arcs.size(); ++n) number[arcs[n]] = n;
  for (const CutRow& row : master_.cuts()) {
    if (row.multiplier == 0) continue;
    const std::uint32_t cut =
        problem.add_row(-row.multiplier, static_cast<std::uint32_t>(row.cut.right_side()));
    for (const CutEntry& entry : row.entries) {
      if (number[entry.arc] != kNone)
        of_cuts[number[entry.arc]].push_back({cut, static_cast<std::uint32_t>(entry.coefficient)});
    }
  }
  return of_cuts;
}

}  // namespace nda::cutting
