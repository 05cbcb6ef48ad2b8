#include "cutting/master.hpp"

#include <algorithm>
#include <cmath>

#include "core/cheapest.hpp"
#include "cutting/cut_bound.hpp"
#include "lp/cost_scale.hpp"

// A linear program of some thousand columns stands for millions of arcs: the multipliers of the
// bundle already tell which ones, so a few rounds of pricing are enough.  Whatever the simplex
// method returns, the bound is computed here from its multipliers, clamped to their signs, over all
// live arcs: it holds even where the simplex method failed.

namespace nda::cutting {
namespace {

using core::ArcId;
using core::Component;

constexpr double kTolerance = 1e-9;
constexpr double kBeyond = 1e-7;
constexpr int kNoIterationLimit = 1 << 30;
constexpr std::size_t kStartArcsPerIndex = 2;
constexpr std::size_t kStartArcs = 1000;
constexpr std::size_t kMostEntering = 6000;
constexpr double kShrunk = 0.5;

}  // namespace

Master::Master(const Component& component, std::vector<ArcId> live, std::span<const double> u)
    : component_(component),
      live_(std::move(live)),
      index_(component, live_),
      index_arcs_(live_.size()),
      lister_(component.num_arcs()),
      column_of_(component.num_arcs(), -1),
      forbidden_(component.num_arcs(), 0),
      forced_(component.num_slots(), 0),
      u_(u.begin(), u.end()),
      reduced_(component.num_arcs(), 0.0) {
  program_.add_empty_rows(static_cast<int>(component.num_slots()));
  double dearest = 0;
  for (const ArcId a : live_) dearest = std::max(dearest, std::abs(component.costs[a]));
  scale_ = lp::cost_scale(dearest, 2 * dearest);
  for (int slot = 0; slot < static_cast<int>(component.num_slots()); ++slot) {
    const double one = 1;
    program_.add_column({{&slot, 1}, {&one, 1}}, 2 * dearest * scale_, kInfinity);
  }
  price();
  std::vector<ArcId> start = live_;
  const std::size_t wanted = kStartArcs + kStartArcsPerIndex * component.num_indices();
  core::keep_cheapest(start, wanted, [&](ArcId a) { return reduced_[a]; });
  insert(start);
}

void Master::insert(std::span<const ArcId> arcs) {
  std::vector<std::vector<std::pair<int, double>>> of_cuts(arcs.size());
  std::vector<int> position(cuts_.empty() ? 0 : component_.num_arcs(), -1);
  if (!cuts_.empty()) {
    for (std::size_t k = 0; k < arcs.size(); ++k) position[arcs[k]] = static_cast<int>(k);
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      const int row = static_cast<int>(component_.num_slots() + c);
      for (const CutEntry& entry : cuts_[c].entries) {
        const int k = position[entry.arc];
        if (k >= 0) of_cuts[static_cast<std::size_t>(k)].emplace_back(row, entry.coefficient);
      }
    }
  }
  std::vector<int> rows;
  std::vector<double> values;
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    rows.clear();
    core::for_each_slot(
        component_, arcs[k], [&](std::uint32_t slot) { rows.push_back(static_cast<int>(slot)); });
    values.assign(rows.size(), 1.0);
    for (const auto& [row, coefficient] : of_cuts[k]) {
      rows.push_back(row);
      values.push_back(coefficient);
    }
    column_of_[arcs[k]] = static_cast<int>(u_.size() + column_arc_.size());
    column_arc_.push_back(arcs[k]);
    program_.add_column({rows, values},
                        component_.costs[arcs[k]] * scale_,
                        forbidden_[arcs[k]] > 0 ? 0.0 : kInfinity);
  }
}

// Reduced costs of all live arcs under u_ and the cuts' multipliers, and the bound they prove.
void Master::price() {
  lower_ = cutting::price(component_, live_, u_, cuts_, forbidden_, reduced_);
}

std::vector<ArcId> Master::entering() const {
  std::vector<ArcId> found;
  for (const ArcId a : live_) {
    if (reduced_[a] * scale_ < -kTolerance && column_of_[a] < 0 && forbidden_[a] == 0)
      found.push_back(a);
  }
  core::keep_cheapest(found, kMostEntering, [&](ArcId a) { return reduced_[a]; });
  return found;
}

lp::Outcome Master::solve(double cutoff, const core::Deadline& deadline) {
  // A little beyond the cutoff, so that the bound computed here reaches it as well.
  double limit = cutoff * scale_ + kBeyond * (1 + std::abs(cutoff * scale_));
  for (;;) {
    const lp::Outcome outcome = dual_feasible_
                                    ? program_.solve_dual(deadline, limit, kNoIterationLimit)
                                    : program_.solve_primal(deadline);
    if (outcome == lp::Outcome::kStopped || outcome == lp::Outcome::kFailed) return outcome;
    take_multipliers();
    price();
    if (lower_ >= cutoff) return lp::Outcome::kCutoff;
    if (outcome == lp::Outcome::kCutoff) {
      limit = kInfinity;  // the bound is not as good as the objective: go on to the optimum
      continue;
    }
    dual_feasible_ = false;
    const std::vector<ArcId> more = entering();
    if (more.empty()) break;
    insert(more);
    if (deadline.reached()) return lp::Outcome::kStopped;
  }
  for (CutRow& row : cuts_) row.idle = row.multiplier * scale_ < -kTolerance ? 0 : row.idle + 1;
  return lp::Outcome::kOptimal;
}

// The program's multipliers with the signs that the bound wants.
void Master::take_multipliers() {
  const std::span<const double> dual = program_.dual();
  for (std::size_t slot = 0; slot < u_.size(); ++slot) {
    u_[slot] = (forced_[slot] > 0 ? dual[slot] : std::min(0.0, dual[slot])) / scale_;
  }
  for (std::size_t c = 0; c < cuts_.size(); ++c) {
    cuts_[c].multiplier = std::min(0.0, dual[u_.size() + c]) / scale_;
  }
}

void Master::forbid(std::span<const ArcId> arcs) {
  for (const ArcId a : arcs) {
    if (forbidden_[a]++ == 0 && column_of_[a] >= 0) program_.set_upper(column_of_[a], 0.0);
  }
  dual_feasible_ = true;
}

void Master::allow(std::span<const ArcId> arcs) {
  for (const ArcId a : arcs) {
    if (--forbidden_[a] == 0 && column_of_[a] >= 0) program_.set_upper(column_of_[a], kInfinity);
  }
  dual_feasible_ = true;
}

void Master::force(std::uint32_t slot) {
  if (forced_[slot]++ > 0) return;
  program_.set_equality(static_cast<int>(slot), true);
  dual_feasible_ = true;
}

void Master::release(std::uint32_t slot) {
  if (--forced_[slot] > 0) return;
  program_.set_equality(static_cast<int>(slot), false);
  dual_feasible_ = true;
}

double Master::trial(int max_iterations, const core::Deadline& deadline) {
  const lp::Outcome outcome = program_.solve_dual(deadline, kInfinity, max_iterations);
  return outcome == lp::Outcome::kFailed ? lower_ : program_.objective() / scale_;
}

void Master::add(const Cut& cut) {
  if (static_cast<double>(live_.size()) < kShrunk * static_cast<double>(index_arcs_))
    rebuild_index();
  cuts_.push_back({cut, lister_.list(cut, index_), 0.0, 0});
  std::vector<int> columns;
  std::vector<double> values;
  for (const CutEntry& entry : cuts_.back().entries) {
    if (column_of_[entry.arc] < 0) continue;
    columns.push_back(column_of_[entry.arc]);
    values.push_back(entry.coefficient);
  }
  program_.add_row({columns, values}, cut.right_side());
  dual_feasible_ = true;
}

void Master::rebuild_index() {
  index_ = SlotIndex(component_, live_);
  index_arcs_ = live_.size();
}

void Master::drop_idle(int most_idle) {
  std::vector<int> rows;
  std::vector<CutRow> kept;
  for (std::size_t c = 0; c < cuts_.size(); ++c) {
    const int row = static_cast<int>(u_.size() + c);
    if (cuts_[c].idle > most_idle && program_.is_slack(row))
      rows.push_back(row);
    else
      kept.push_back(std::move(cuts_[c]));
  }
  cuts_ = std::move(kept);
  program_.remove_rows(rows);
}

bool Master::fix(double cutoff) {
  const auto dead = [&](ArcId a) { return lower_ + reduced_[a] >= cutoff; };
  std::vector<int> columns;
  for (std::size_t k = 0; k < column_arc_.size(); ++k) {
    if (!dead(column_arc_[k])) continue;
    columns.push_back(static_cast<int>(u_.size() + k));
    column_of_[column_arc_[k]] = -1;
  }
  program_.remove_columns(columns);
  std::erase_if(column_arc_, dead);
  for (std::size_t k = 0; k < column_arc_.size(); ++k) {
    column_of_[column_arc_[k]] = static_cast<int>(u_.size() + k);
  }
  for (CutRow& row : cuts_) {
    std::erase_if(row.entries, [&](const CutEntry& entry) { return dead(entry.arc); });
  }
  return std::erase_if(live_, dead) > 0;
}

}  // namespace nda::cutting
