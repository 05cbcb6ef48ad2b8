#include "nda/solve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/double_double.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "nda/check.hpp"
#include "solve/costs.hpp"
#include "solve/hot_start.hpp"
#include "solve/infeasibility.hpp"
#include "solve/many_to_one.hpp"
#include "solve/monitor.hpp"
#include "solve/parallel.hpp"
#include "solve/part.hpp"
#include "solve/penalties.hpp"
#include "solve/process.hpp"
#include "solve/singletons.hpp"
#include "solve/solutions.hpp"
#include "solve/supervision.hpp"

// The pipeline: shift, split, solve the parts in two rounds, merge.  The first round gives every
// component a solution and a bound, the second works on those that are not yet closed.  Components
// are independent, so they run in parallel and the answer does not depend on how many at once.

namespace nda {
namespace {

using core::ArcId;
using core::Component;
using pipeline::ComponentSolver;
using pipeline::ComponentState;
using pipeline::Monitor;
using pipeline::Part;

// What merging takes, for the most part the certificate: per dimension of an arc, and per index.
constexpr double kMergeSecondsPerEntry = 3e-9;
constexpr double kMergeSecondsPerIndex = 2e-8;
// What it takes to pass over a component once more, merge it and free it.
constexpr double kMergeSecondsPerPart = 2e-6;

constexpr double kWholeShare = 0.9;

class Pipeline {
 public:
  // modest: where a penalty that is surely enough would hide digits of the costs, a lower one.
  Pipeline(const Problem& problem, const Options& options, const WarmStart& warm, bool modest)
      : problem_(problem),
        options_(options),
        warm_(warm),
        modest_(modest),
        supervision_(options.progress, options.stop, work_limit()) {}

  Solution run() {
    const double largest = pipeline::largest_cost(problem_);
    if (largest > pipeline::kLargestCost) return pipeline::overflow(problem_, largest);
    prepare();
    if (is_bounded_) work();
    return merge();
  }

  // After run(): the best solution leaves an index uncovered that a higher penalty might cover.
  bool needs_higher_penalty() const {
    return is_bounded_ && !shift_.is_enough && !missing_.empty() && !is_infeasible_ &&
           !deadline_.reached();
  }

 private:
  double work_limit() const {
    const double entries =
        static_cast<double>(problem_.num_arcs()) * static_cast<double>(problem_.num_dimensions());
    return options_.time_limit_s - kMergeSecondsPerEntry * entries -
           kMergeSecondsPerIndex * static_cast<double>(problem_.num_indices());
  }

  // Shifts, splits, and finds a first bound for every component, as far as the deadline lets it.
  void prepare() {
    shift_ = core::make_shift(problem_, deadline_);
    grid_ = core::find_grid(problem_, deadline_);
    if (modest_ && pipeline::hides_digits(problem_, shift_, grid_))
      shift_ = core::make_shift(problem_, deadline_, pipeline::modest_penalty(problem_));
    for (const std::vector<double>& row : shift_.base) {
      for (const double charge : row) constant_.add(charge);
    }
    if (may_start_hot()) hot_ = pipeline::make_hot_start(problem_, shift_, grid_, warm_, deadline_);
    partition_ = hot_ ? decompose::partition(hot_->open, deadline_)
                      : decompose::partition(problem_, shift_, deadline_);
    if (!options_.relaxation.decompose) decompose::join(partition_);
    if (deadline_.reached()) return;
    parts_.resize(partition_.num_components());
    supervision_.shorten(kMergeSecondsPerPart * static_cast<double>(parts_.size()));
    const double settled = hot_ ? hot_->settled_cost : 0;
    monitor_.begin(shift_.constant + settled, parts_.size(), num_infeasible());
    const auto workers = static_cast<std::size_t>(pipeline::num_workers(options_.num_threads));
    std::vector<core::Cutter> cutters(workers);
    settlers_.resize(workers);
    for_all_parts([&](std::size_t p, std::size_t worker) {
      prepare_part(p, cutters[worker], settlers_[worker]);
    });
    is_bounded_ = std::all_of(parts_.begin(), parts_.end(), [](const Part& part) {
      return part.settled || (part.solver != nullptr && part.solver->bounded());
    });
  }

  // A proof must speak of all arcs, and what pays penalties says nothing of them.
  bool may_start_hot() const {
    return !warm_.empty() && !options_.proof && shift_.penalty == 0 &&
           options_.method != Method::kRelaxation;
  }

  void work() {
    const auto open = [&] { return total(&best_cost) - total(&lower_bound); };
    const bool is_near = hot_ && open() <= allowed_gap();
    if (!is_near) start_parts();
    if (is_penalty_too_low()) return;
    const double gap = allowed_gap();
    const double still_open = open();
    const auto gap_of = [](const Part& part) {
      return part.state().best.cost - part.state().lower;
    };
    for_open_parts(gap_of, [&](Part& part) {
      const double share = still_open > 0 ? gap_of(part) / still_open : 0.0;
      part.solver->finish(share > 0 ? gap * share : 0.0);
    });
  }

  void start_parts() {
    for_open_parts([](const Part& part) { return static_cast<double>(part.component.num_arcs()); },
                   [](Part& part) { part.solver->start(); });
  }

  // Something is done with and pays it.
  bool is_penalty_too_low() const {
    return !shift_.is_enough && std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
      return part.state().complete && !part.state().feasible;
    });
  }

  // Those that are not settled: on one thread as they come, on several by falling `size`, so that
  // no long one is left for the end, when the other threads are done.
  template <typename Size, typename Work>
  void for_open_parts(Size&& size, Work&& work) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      if (!parts_[p].settled) order.emplace_back(-size(parts_[p]), p);
    }
    if (pipeline::num_workers(options_.num_threads) > 1) std::sort(order.begin(), order.end());
    pipeline::for_all(order.size(), options_.num_threads, [&](std::size_t i, std::size_t) {
      work(parts_[order[i].second]);
    });
  }

  template <typename Work>
  void for_all_parts(Work&& work) {
    pipeline::for_all(parts_.size(), options_.num_threads, work);
  }

  void prepare_part(std::size_t p, core::Cutter& cutter, pipeline::Settler& settler) {
    if (deadline_.reached()) return;
    Part& part = parts_[p];
    pipeline::Hint hint;
    if (hot_) {
      pipeline::HotPart hot = pipeline::cut_part(*hot_, partition_.component(p), cutter, deadline_);
      part.component = std::move(hot.component);
      hint = std::move(hot.hint);
    } else if (mostly_whole()) {
      partition_ = {};
      part.component = core::whole_problem(problem_, shift_, deadline_);
    } else {
      part.component = cutter.cut(problem_, shift_, partition_.component(p), deadline_);
    }
    if (part.component.num_arcs() == 0) return;
    if (options_.proof) {
      part.proof =
          std::make_unique<bnb::ProofLog>(part.component,
                                          pipeline::charges(part.component, shift_),
                                          pipeline::precision_of(part.component, grid_).error);
    }
    std::vector<bool> required;
    if (shift_.penalty > 0) required = pipeline::required_slots(part.component, problem_);
    if (required.empty() && options_.method != Method::kRelaxation) {
      part.settled = settler.settle(part.component, grid_, options_.search.reductions);
      if (part.settled) return pipeline::tell(part.settled->state, monitor_);
    }
    part.solver = std::make_unique<ComponentSolver>(part.component,
                                                    std::move(required),
                                                    hint,
                                                    options_,
                                                    grid_,
                                                    options_.seed + 1000003 * p,
                                                    deadline_,
                                                    monitor_,
                                                    part.proof.get());
  }

  // What must become feasible before the whole is: the components, and whatever is in none.
  std::size_t num_infeasible() const {
    if (shift_.penalty == 0) return 0;
    return parts_.size() + (pipeline::indices_without_arcs(problem_).empty() ? 0 : 1);
  }

  // One component with nearly all arcs: then a copy would only cost memory.
  bool mostly_whole() const {
    return partition_.num_components() == 1 &&
           static_cast<double>(partition_.arcs.size()) >
               kWholeShare * static_cast<double>(problem_.num_arcs()) &&
           std::find(problem_.sizes().begin(), problem_.sizes().end(), 0u) ==
               problem_.sizes().end();
  }

  // The absolute gap that may stay open.  The final cost lies between the bounds of now, so it is
  // relative to the smallest cost in size among these; rounding takes its part of it.
  double allowed_gap() const {
    const double best = total(&best_cost);
    const double lower = total(&lower_bound);
    const double least = best < 0 ? -best : std::max(0.0, lower);
    if (least == 0) return 0;
    double rounding = 0;
    for (const Part& part : parts_) rounding += 2 * part.precision().error;
    return std::max(0.0, options_.relative_gap * least - rounding);
  }

  static double best_cost(const ComponentState& state) { return state.best.cost; }
  static double lower_bound(const ComponentState& state) { return state.lower; }

  // Constant plus the sum of one figure over all components.
  double total(double (*figure)(const ComponentState&)) const {
    core::DoubleDouble sum = constant_;
    if (hot_) sum.add(hot_->settled_cost);
    for (const Part& part : parts_) sum.add(figure(part.state()));
    return sum.high();
  }

  Solution merge() {
    Solution solution = pipeline::solution_of(problem_);
    solution.num_components = parts_.size();
    merge_arcs(solution);
    for (const Part& part : parts_) {
      if (!part.is_known()) continue;
      report(part, solution);
      pipeline::count(part, solution.stats);
    }
    for (const pipeline::Settler& settler : settlers_) settler.count(solution.stats);
    if (hot_) pipeline::count(*hot_, solution.stats);
    merge_multipliers(solution);
    merge_bounds(solution);
    set_status(solution);
    if (options_.proof && is_bounded_ && !is_infeasible_ && !needs_higher_penalty())
      prove(solution);
    solution.stats.solve_seconds = deadline_.seconds();
    solution.stats.peak_memory_bytes = pipeline::peak_memory_bytes();
    return solution;
  }

  void prove(Solution& solution) {
    Proof& proof = solution.proof.emplace();
    proof.sizes = solution.sizes;
    proof.num_arcs = solution.num_arcs;
    proof.grid = grid_.step;
    for (Part& part : parts_) {
      if (part.settled) {
        part.proof->bound(part.state().u);
      } else {
        part.solver->finish_proof();
      }
      proof.parts.push_back(part.proof->take());
    }
  }

  void report(const Part& part, Solution& solution) const {
    const ComponentState& state = part.state();
    double base = 0;
    bool feasible = true;
    core::for_each_index(part.component, [&](std::uint32_t, std::size_t k, Index i) {
      base += shift_.base[k][i];
      feasible = feasible && !is_missing(k, i);
    });
    ComponentReport line{part.component.num_arcs(),
                         part.component.num_indices(),
                         is_bounded_ || part.settled ? state.stopped : why_stopped(),
                         state.complete && feasible,
                         feasible ? base + state.best.cost : kInfinity,
                         base + state.lower,
                         state.method};
    line.lower_bound = std::min(line.lower_bound, line.cost);  // the base may be rounded away
    if (state.complete && !feasible) {
      line.status = shift_.is_enough ? Status::kInfeasible : pipeline::out_of_time(deadline_);
      if (shift_.is_enough) line.lower_bound = kInfinity;
    }
    solution.components.push_back(std::move(line));
  }

  void merge_arcs(Solution& solution) {
    std::vector<ArcId> arcs;
    if (hot_) arcs = hot_->settled;
    for (const Part& part : parts_) {
      if (!part.is_known()) continue;
      for (const ArcId a : part.state().best.arcs) {
        arcs.push_back(core::original_arc(part.component, a));
      }
    }
    std::sort(arcs.begin(), arcs.end());
    covered_ = pipeline::coverage(problem_, arcs);
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem_.size(k); ++i) {
        if (is_missing(static_cast<std::size_t>(k), i)) missing_.push_back({k, i});
      }
    }
    if (!missing_.empty()) return;
    solution.solutions.push_back(pipeline::make_solution(problem_, arcs, covered_));
    solution.cost = solution.solutions.front().cost;
  }

  // Uncovered though its singleton is forbidden.
  bool is_missing(std::size_t k, Index i) const {
    return !covered_[k][i] && problem_.singleton_costs(static_cast<int>(k))[i] == kInfinity;
  }

  void merge_multipliers(Solution& solution) {
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const std::vector<double>& base = shift_.base[static_cast<std::size_t>(k)];
      solution.multipliers.emplace_back(base.begin() + 1, base.end());
    }
    if (!is_bounded_) drop_penalties(solution);
    if (hot_) {
      for (const Part& part : parts_) {
        if (part.is_known()) pipeline::learn(*hot_, part.component, part.state().u);
      }
      return pipeline::add_multipliers(*hot_, solution.multipliers);
    }
    for (const Part& part : parts_) {
      // With the penalties dropped, multipliers that were found for them fit no longer.
      if (!part.is_known() || (!is_bounded_ && shift_.penalty > 0)) continue;
      const std::vector<double>& u = part.state().u;
      core::for_each_index(part.component, [&](std::uint32_t slot, std::size_t k, Index i) {
        solution.multipliers[k][i - 1] += u[slot];
      });
    }
  }

  // Without multipliers to go with it the penalty of a forbidden singleton proves next to nothing.
  void drop_penalties(Solution& solution) const {
    for (int k = 0; k < problem_.num_dimensions(); ++k) {
      const auto costs = problem_.singleton_costs(k);
      for (Index i = 1; i < costs.size(); ++i) {
        if (costs[i] == kInfinity) solution.multipliers[static_cast<std::size_t>(k)][i - 1] = 0;
      }
    }
  }

  void merge_bounds(Solution& solution) const {
    const double certificate = certificate_bound(problem_, solution.multipliers);
    solution.stats.certificate_bound = solution.lower_bound = certificate;
    if (is_bounded_)
      solution.lower_bound = std::max(solution.lower_bound, bound_of_parts(solution));
    if (!solution.solutions.empty()) {
      solution.lower_bound = std::min(solution.lower_bound, solution.cost);
      // Where the certificate meets the cost by itself, what branching adds is mere rounding; but
      // an exact bound on a cost of 0 is more than a small difference.
      const bool is_zero = solution.cost == 0 && solution.lower_bound == 0;
      if (!is_zero && pipeline::is_negligible(problem_, solution.cost - certificate, solution.cost))
        solution.lower_bound = certificate;
    }
    solution.stats.bound_by_branching = solution.lower_bound > certificate;
  }

  double bound_of_parts(const Solution& solution) const {
    double error = hot_ ? hot_->precision.error : 0;
    bool exact = !solution.solutions.empty() && (!hot_ || hot_->precision.on_grid());
    for (const Part& part : parts_) {
      error += part.precision().error;
      exact = exact && part.state().complete && part.precision().on_grid();
    }
    // On a grid a proof to less than a step is a proof of the cost, but for the rounding that put
    // the costs beside their grid points.
    if (!exact) return total(&lower_bound) - error;
    return solution.cost - (grid_.exact ? 0.0 : pipeline::off_grid(problem_, solution.cost));
  }

  void set_status(Solution& solution) {
    bool complete = is_bounded_;
    bool on_grid = !hot_ || hot_->precision.on_grid();
    bool infeasible = false;
    double error = hot_ ? 2 * hot_->precision.error : 0;
    for (const Part& part : parts_) {
      if (!part.is_known()) continue;
      const ComponentState& state = part.state();
      error += 2 * part.precision().error;
      on_grid = on_grid && part.precision().on_grid();
      complete = complete && state.complete;
      infeasible = infeasible || (state.complete && !state.feasible);
    }
    if (!missing_.empty()) return set_infeasible(solution, complete || infeasible);
    // However coarse the search was, a certificate that meets the cost is beyond doubt.
    const double open = solution.cost - solution.stats.certificate_bound;
    if (complete &&
        (on_grid || pipeline::is_negligible(problem_, std::min(error, open), solution.cost))) {
      solution.status = Status::kOptimal;
      solution.proven = solution.solutions.front().proven = true;
    } else if (complete) {
      solution.status = Status::kPrecisionLost;
      solution.reason = pipeline::rounding_reason(error);
    } else if (options_.relative_gap > 0 && solution.relative_gap() <= options_.relative_gap) {
      solution.status = Status::kGapReached;
    } else {
      solution.status = why_stopped();
    }
  }

  // The gravest reason of the components that are not complete.
  Status why_stopped() const {
    if (!is_bounded_) return pipeline::out_of_time(deadline_);
    for (const Status status : pipeline::kReasonsToStop) {
      const auto stopped_so = [&](const Part& part) { return part.state().stopped == status; };
      if (std::any_of(parts_.begin(), parts_.end(), stopped_so)) return status;
    }
    // Something complete is uncovered: there was no time for a higher penalty.
    return missing_.empty() ? Status::kGapReached : pipeline::out_of_time(deadline_);
  }

  void set_infeasible(Solution& solution, bool complete) {
    solution.cost = kInfinity;
    is_infeasible_ =
        (complete && shift_.is_enough) || !pipeline::indices_without_arcs(problem_).empty();
    if (is_infeasible_) {
      solution.status = Status::kInfeasible;
      solution.lower_bound = kInfinity;
      solution.multipliers.clear();
      solution.stats.certificate_bound = -kInfinity;
      solution.stats.bound_by_branching = true;
      solution.reason = pipeline::infeasibility_reason(problem_, missing_, deadline_);
    } else {
      solution.status = why_stopped();
      solution.lower_bound = solution.stats.certificate_bound;
      solution.stats.bound_by_branching = false;
    }
  }

  const Problem& problem_;
  const Options& options_;
  const WarmStart& warm_;
  const bool modest_;
  pipeline::Supervision supervision_;
  const core::Deadline& deadline_ = supervision_.deadline();
  Monitor& monitor_ = supervision_.monitor();
  core::Shift shift_;
  core::DoubleDouble constant_;  // of it, the sum of all base
  core::CostGrid grid_;
  std::optional<pipeline::HotStart> hot_;
  decompose::Partition partition_;  // of what the hot start leaves open, or else of all
  std::vector<Part> parts_;
  std::vector<pipeline::Settler> settlers_;   // one a worker
  pipeline::Coverage covered_;                // by the best packings
  std::vector<pipeline::RealIndex> missing_;  // forbidden singletons among the rest, ascending
  bool is_bounded_ = false;                   // every part has a solver and a bound
  bool is_infeasible_ = false;
};

Solution solve_once(const Problem& problem, const Options& options, const WarmStart& warm_start) {
  return pipeline::solve_by_penalties(options, [&](const Options& run, bool modest) {
    Pipeline pipeline(problem, run, warm_start, modest);
    Solution solution = pipeline.run();
    return pipeline::PenalisedRun{std::move(solution), pipeline.needs_higher_penalty()};
  });
}

}  // namespace

Solution solve(const Problem& problem, const Options& options, const WarmStart& warm_start) {
  if (problem.num_dimensions() == 0) throw InputError("the problem was moved from: 0 dimensions");
  validate(options);
  if (!problem.is_many_to_one()) return solve_once(problem, options, warm_start);
  return pipeline::solve_many_to_one(problem, options, warm_start, solve_once);
}

}  // namespace nda
