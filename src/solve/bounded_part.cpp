#include "solve/bounded_part.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bounded/split.hpp"
#include "core/fault_text.hpp"
#include "solve/bounded_hint.hpp"
#include "solve/supervision.hpp"

namespace nda::pipeline {
namespace {

using bounded::BoundedComponent;
using bounded::BoundedState;

constexpr std::size_t kMostNames = 8;
// Missing uses are counted: one less is less by 1.
constexpr double kCountMargin = 0.5;
// What bounds from a linear program can be relied on to reach, relative to the sum of all sizes.
constexpr double kProgramError = 0x1p-43;

// Costs nothing but missing uses of indices with forbidden singletons, 1 each.
BoundedComponent counting(BoundedComponent component) {
  std::fill(component.graph.costs.begin(), component.graph.costs.end(), 0.0);
  for (bounded::Row& row : component.rows) {
    if (!row.is_forced) row.lo = 0;
    row.single = row.is_forced ? 1 : 0;
  }
  return component;
}

}  // namespace

Precision precision_of_part(const BoundedComponent& component, const core::CostGrid& grid) {
  const double scale = bounded::most_uses(component) * bounded::largest_cost(component);
  Precision precision;
  precision.error = 0x1p-50 * scale;
  const bool on_grid = grid.step > 16 * precision.error;
  if (on_grid) {
    precision.margin = grid.step - 4 * precision.error;
  } else {
    precision.error = precision.margin = kProgramError * scale;
  }
  return precision;
}

BoundedPart::BoundedPart(BoundedComponent component,
                         const Options& options,
                         const core::CostGrid& grid,
                         const core::Deadline& deadline,
                         Monitor& monitor)
    : component_(std::move(component)),
      options_(options),
      grid_(grid),
      deadline_(deadline),
      monitor_(monitor) {
  make_solver();
  monitor_.add_component(state().lower);
  monitor_.moved(state().best.cost, 0, "begin");
  look();
}

void BoundedPart::make_solver() {
  precision_ = precision_of_part(component_, grid_);
  solver_ = std::make_unique<bounded::BoundedSolver>(
      component_,
      options_,
      precision_.margin,
      deadline_,
      [this](double cost_change, double bound_change, const char* event) {
        moved(cost_change, bound_change, event);
      });
}

void BoundedPart::moved(double cost_change, double bound_change, const char* event) {
  look();
  monitor_.moved(cost_change, bound_change, event);
}

// Whether the best choice is a solution by now; and if it is the best.
void BoundedPart::look() {
  if (!is_feasible_ && missing_uses(component_, state().best.arcs) == 0) {
    is_feasible_ = true;
    monitor_.component_feasible();
  }
  if (is_done_ || !state().complete) return;
  is_done_ = true;
  monitor_.component_done();
}

void BoundedPart::start(const WarmStart& warm) {
  const bool is_warm = options_.method != Method::kRelaxation;
  solver_->start(is_warm ? make_hint(component_, warm) : bounded::BoundedHint{});
  look();
}

void BoundedPart::finish(double allowed_gap) {
  solver_->finish(is_feasible_ ? allowed_gap : 0);
  if (!is_feasible_ && !deadline_.reached()) seek_solution(allowed_gap);
  look();
}

void BoundedPart::seek_solution(double allowed_gap) {
  const BoundedComponent count = counting(component_);
  Options options = options_;
  options.method = Method::kExact;
  bounded::BoundedSolver seeker(count, options, kCountMargin, deadline_, {});
  seeker.start();
  seeker.finish(0);
  if (seeker.state().complete && seeker.state().best.cost > kCountMargin) {
    reason_ = why_infeasible(count, seeker.state());
    return;
  }
  if (seeker.state().best.cost > kCountMargin) return;
  const BoundedState before = state();
  const bounded::Choice found = make_choice(component_, seeker.state().best.arcs);
  bounded::set_penalties_above(component_, found.cost);
  make_solver();
  monitor_.moved(state().best.cost - before.best.cost, 0, "penalties");
  solver_->offer(found, "feasible");
  solver_->start();
  solver_->finish(allowed_gap);
}

// Where multipliers alone prove it, the indices that these ask uses of cannot all have them.
std::string BoundedPart::why_infeasible(const BoundedComponent& count,
                                        const BoundedState& state) const {
  const bool by_multipliers = state.certificate > 0;
  std::string names;
  std::size_t number = 0;
  core::for_each_index(count.graph, [&](std::uint32_t slot, std::size_t k, Index i) {
    if (!count.rows[slot].is_forced || count.rows[slot].lo == 0) return;
    if (by_multipliers && state.u[slot] <= 0) return;
    if (number++ < kMostNames) names += (names.empty() ? "" : ", ") + core::index_text(k, i);
  });
  if (number > kMostNames) names += " and " + std::to_string(number - kMostNames) + " more";
  const auto missing = static_cast<long long>(std::llround(state.best.cost));
  return names +
         (number == 1 ? " cannot be used as often as it must"
                      : " cannot all be used as often as they must") +
         ": " + std::to_string(missing) + (missing == 1 ? " use is" : " uses are") +
         " missing at least";
}

ComponentReport BoundedPart::report() const {
  const BoundedState& known = state();
  ComponentReport line{component_.num_arcs(),
                       component_.graph.num_indices(),
                       known.stopped,
                       known.complete && is_feasible_,
                       is_feasible_ ? known.best.cost : kInfinity,
                       std::min(lower_bound(), known.best.cost),
                       known.method};
  if (is_infeasible()) {
    line.status = Status::kInfeasible;
    line.lower_bound = kInfinity;
  } else if (known.complete && !is_feasible_) {
    line.status = out_of_time(deadline_);
  }
  return line;
}

}  // namespace nda::pipeline
