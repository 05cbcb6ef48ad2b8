#include "solve/penalties.hpp"

#include <algorithm>
#include <utility>

#include "solve/component_solver.hpp"
#include "solve/costs.hpp"

// Any penalty gives a relaxation: solutions that pay none cost what they cost.  So a best one that
// pays none is the best, however low the penalty.  That nothing covers all indices is proven by a
// penalty that is surely enough, and only by that.

namespace nda::pipeline {
namespace {

constexpr double kArcsPerDimension = 16;
constexpr double kNegligible = 1e-9;

void add(const Stats& first, Stats& stats) {
  stats.solve_seconds += first.solve_seconds;
  stats.dual_evaluations += first.dual_evaluations;
  stats.recoveries += first.recoveries;
  stats.nodes += first.nodes;
  stats.branching += first.branching;
  stats.searches += first.searches;
}

// Multipliers that proved more than those of a run that was cut short.
void keep_certificate(const Solution& first, Solution& solution) {
  const double bound = std::min(first.stats.certificate_bound, solution.cost);
  if (solution.status == Status::kInfeasible || bound <= solution.lower_bound) return;
  solution.multipliers = first.multipliers;
  solution.stats.certificate_bound = first.stats.certificate_bound;
  solution.lower_bound = bound;
  solution.stats.bound_by_branching = false;
}

}  // namespace

bool hides_digits(const Problem& problem, const core::Shift& shift, const core::CostGrid& grid) {
  const double charges = problem.num_dimensions() * shift.penalty;
  const Precision precision = precision_of(problem.num_indices(), charges, grid);
  if (grid.step > 0) return !precision.on_grid();
  return precision.error > kNegligible * largest_cost(problem);
}

double modest_penalty(const Problem& problem) {
  return kArcsPerDimension * (problem.num_dimensions() + 1) * largest_cost(problem);
}

Solution solve_by_penalties(
    const Options& options,
    const std::function<PenalisedRun(const Options& options, bool modest)>& run) {
  Options watched = options;
  Progress last;
  if (options.progress) {
    watched.progress = [&](const Progress& now) { return options.progress(last = now); };
  }
  PenalisedRun first = run(watched, true);
  if (!first.needs_higher_penalty) return std::move(first.solution);
  const double seconds = first.solution.stats.solve_seconds;
  watched.time_limit_s = std::max(options.time_limit_s - seconds, 1e-9);
  if (options.progress) {
    watched.progress = [&](Progress now) {
      now.seconds += seconds;
      now.lower_bound = std::max(now.lower_bound, last.lower_bound);
      now.components_done = std::max(now.components_done, last.components_done);
      return options.progress(now);
    };
  }
  Solution solution = run(watched, false).solution;
  add(first.solution.stats, solution.stats);
  keep_certificate(first.solution, solution);
  return solution;
}

}  // namespace nda::pipeline
