#include "solve/many_to_one.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "bounded/bounded_solver.hpp"
#include "bounded/split.hpp"
#include "core/double_double.hpp"
#include "core/shift.hpp"
#include "core/use_bounds.hpp"
#include "nda/check.hpp"
#include "solve/bounded_part.hpp"
#include "solve/costs.hpp"
#include "solve/parallel.hpp"
#include "solve/process.hpp"
#include "solve/solutions.hpp"
#include "solve/supervision.hpp"
#include "solve/uses.hpp"

// Parts with bounds have two stages, like the components of the ordinary pipeline, which solves the
// rest between the two, or before them where it is small: so a deadline finds everything with a
// solution and a bound.  The rest is one more part to the monitor.

namespace nda::pipeline {
namespace {

using core::ArcId;

// Of the time that is left, what the rest may take at least when parts are open.
constexpr double kLeastShare = 0.1;
constexpr double kMergeSecondsPerEntry = 2e-8;

class ManyToOne {
 public:
  ManyToOne(const Problem& problem,
            const Options& options,
            const WarmStart& warm,
            const SolveOnce& solve_once)
      : problem_(problem),
        options_(options),
        warm_(warm),
        solve_once_(solve_once),
        supervision_(options.progress, options.stop, work_limit()) {}

  Solution run() {
    const double largest = largest_cost(problem_);
    if (largest > kLargestCost) return overflow_with_bounds(largest);
    grid_ = core::find_grid(problem_, deadline_);
    split_ = bounded::split(problem_, deadline_);
    if (!split_.infeasible.empty()) return infeasible(split_.infeasible);
    if (!split_.rest) return without_search();
    prepare();
    if (is_rest_small()) solve_rest(rest_options());
    for_all_parts([&](BoundedPart& part) { part.start(warm_); });
    if (!rest_ || !rest_->proven) solve_rest(rest_options());
    const double gap = allowed_gap();
    const double share = parts_.empty() ? 0 : gap / static_cast<double>(parts_.size());
    for_all_parts([&](BoundedPart& part) { part.finish(share); });
    if (wants_more()) solve_rest(with_limit(deadline_.remaining_s()));
    return merge();
  }

 private:
  double work_limit() const {
    const double entries =
        static_cast<double>(problem_.num_arcs()) * static_cast<double>(problem_.num_dimensions()) +
        static_cast<double>(problem_.num_indices());
    return options_.time_limit_s - kMergeSecondsPerEntry * entries;
  }

  void prepare() {
    monitor_.begin(settled_cost().high(), split_.parts.size() + 1, split_.parts.size() + 1);
    std::stable_sort(split_.parts.begin(), split_.parts.end(), [](const auto& a, const auto& b) {
      return a.num_arcs() < b.num_arcs();
    });
    for (bounded::BoundedComponent& component : split_.parts) {
      parts_.push_back(std::make_unique<BoundedPart>(
          std::move(component), options_, grid_, deadline_, monitor_));
    }
  }

  // Small parts first: a large one may take all the time there is.
  template <typename Work>
  void for_all_parts(Work&& work) {
    for_all(
        parts_.size(), options_.num_threads, [&](std::size_t p, std::size_t) { work(*parts_[p]); });
  }

  Options with_limit(double seconds) {
    Options options = options_;
    options.time_limit_s = std::max(seconds, 1e-9);
    options.relative_gap = 0;
    options.stop = deadline_.stop();
    options.progress = [this](const Progress& now) { return hear(now); };
    return options;
  }

  // It takes next to no time, and without it no bound is worth anything.
  bool is_rest_small() const {
    double arcs = 0;
    for (const auto& part : parts_) arcs += static_cast<double>(part->component().num_arcs());
    return static_cast<double>(split_.rest->num_arcs()) < kLeastShare * arcs;
  }

  // The whole gap is for the rest where nothing else is open; what it costs more, the parts make
  // good.
  Options rest_options() {
    double open_arcs = 0;
    for (const auto& part : parts_) {
      if (!part->state().complete) open_arcs += static_cast<double>(part->component().num_arcs());
    }
    const auto arcs = static_cast<double>(split_.rest->num_arcs());
    const double share = open_arcs == 0 ? 1.0 : std::max(kLeastShare, arcs / (arcs + open_arcs));
    Options options = with_limit(share * deadline_.remaining_s());
    options.relative_gap = options_.relative_gap;
    return options;
  }

  void solve_rest(const Options& options) {
    Solution solved = solve_once_(*split_.rest, options, warm_);
    const bool is_better =
        !rest_ || solved.lower_bound > rest_->lower_bound || solved.cost < rest_->cost;
    if (!is_better && !solved.proven) return;
    rest_ = std::move(solved);
    Progress now;
    now.cost = rest_->cost;
    now.lower_bound = rest_->lower_bound;
    now.event = "rest";
    hear(now);
  }

  // Passes on what the rest tells.  Returns whether to go on.
  bool hear(const Progress& now) {
    if (!heard_ && now.lower_bound > -kInfinity) {
      heard_ = true;
      heard_bound_ = now.lower_bound;
      monitor_.add_component(heard_bound_);
    }
    const double lower = heard_ ? std::max(heard_bound_, now.lower_bound) : 0;
    const double cost = now.cost < kInfinity ? now.cost : heard_cost_;
    if (!has_cost_ && now.cost < kInfinity) {
      has_cost_ = true;
      monitor_.component_feasible();
    }
    const double cost_change = cost - heard_cost_;
    const double bound_change = lower < kInfinity ? lower - heard_bound_ : 0;
    heard_cost_ = cost;
    heard_bound_ += bound_change;
    if (cost_change != 0 || bound_change != 0) monitor_.moved(cost_change, bound_change, now.event);
    return !deadline_.interrupted();
  }

  // The absolute gap that parts may leave open, less what the rest does.
  double allowed_gap() const {
    if (options_.relative_gap == 0) return 0;
    const double best = total(true);
    const double lower = total(false);
    const double least = best < 0 ? -best : std::max(0.0, lower);
    return std::max(0.0, options_.relative_gap * least - (rest_->cost - rest_->lower_bound));
  }

  // The rest met the gap by itself, but the whole does not; or its share of the time was too short.
  bool wants_more() const {
    if (rest_->proven || deadline_.reached()) return false;
    if (options_.relative_gap == 0) return rest_->status == Status::kTimeLimit;
    const double cost = total(true);
    return !(cost - total(false) <= options_.relative_gap * std::abs(cost));
  }

  // What is known without a search.
  core::DoubleDouble settled_cost() const {
    core::DoubleDouble sum(split_.constant);
    for (const double cost : split_.taken_cost) sum.add(cost);
    return sum;
  }

  double total(bool of_cost) const {
    core::DoubleDouble sum = settled_cost();
    sum.add(of_cost ? rest_->cost : rest_->lower_bound);
    for (const auto& part : parts_)
      sum.add(of_cost ? part->state().best.cost : part->lower_bound());
    return sum.high();
  }

  // What rounding may have taken from, or added to, the sum of bounds.
  double error() const {
    double sum = 0;
    for (const auto& part : parts_) sum += part->error();
    return sum + 0x1p-50 * (std::abs(total(true)) + std::abs(split_.constant));
  }

  void set_time(Solution& solution) const {
    solution.stats.solve_seconds = deadline_.seconds();
    solution.stats.peak_memory_bytes = peak_memory_bytes();
  }

  Solution infeasible(const std::string& reason) const {
    Solution solution = solution_of(problem_);
    solution.status = Status::kInfeasible;
    solution.lower_bound = kInfinity;
    solution.stats.bound_by_branching = true;
    solution.reason = reason;
    set_time(solution);
    return solution;
  }

  // The deadline struck before anything was known: nothing chosen, if that is a solution.
  Solution without_search() const {
    Solution solution = solution_of(problem_);
    solution.status = out_of_time(deadline_);
    offer(solution, {});
    for (const Index size : problem_.sizes()) solution.multipliers.emplace_back(size, 0.0);
    set_certificate(solution);
    set_time(solution);
    return solution;
  }

  // As of one-to-one problems: nothing chosen, multipliers 0.
  Solution overflow_with_bounds(double largest) const {
    Solution solution = without_search();
    solution.status = Status::kPrecisionLost;
    solution.reason = overflow_reason(largest);
    return solution;
  }

  // The solution of these arcs, if all that must be used are and its cost does not overflow.
  void offer(Solution& solution, std::vector<ArcId> arcs) const {
    std::optional<RankedSolution> best = solution_of_uses(problem_, std::move(arcs));
    if (!best || !std::isfinite(best->cost)) return;
    solution.cost = best->cost;
    solution.solutions.push_back(std::move(*best));
  }

  void set_certificate(Solution& solution) const {
    release_unusable(problem_, solution.multipliers);
    const double certificate = certificate_bound(problem_, solution.multipliers);
    solution.stats.certificate_bound = certificate;
    solution.lower_bound = std::min(certificate, solution.cost);
  }

  Solution merge() {
    Solution solution = solution_of(problem_);
    solution.num_components = rest_->num_components + split_.taken.size() + parts_.size();
    merge_stats(solution);
    for (const auto& part : parts_) {
      if (part->is_infeasible()) return keep_reports(infeasible(part->reason()), solution);
    }
    if (rest_->status == Status::kInfeasible)
      return keep_reports(infeasible(rest_->reason), solution);
    if (rest_->cost < kInfinity && all_feasible()) offer(solution, chosen_arcs());
    merge_multipliers(solution);
    set_certificate(solution);
    merge_bounds(solution);
    set_status(solution);
    set_time(solution);
    return solution;
  }

  static Solution keep_reports(Solution infeasible, Solution& merged) {
    const double seconds = infeasible.stats.solve_seconds;
    const std::size_t memory = infeasible.stats.peak_memory_bytes;
    infeasible.num_components = merged.num_components;
    infeasible.components = std::move(merged.components);
    infeasible.stats = merged.stats;
    infeasible.stats.solve_seconds = seconds;
    infeasible.stats.peak_memory_bytes = memory;
    infeasible.stats.certificate_bound = -kInfinity;
    infeasible.stats.bound_by_branching = true;
    return infeasible;
  }

  bool all_feasible() const {
    return std::all_of(
        parts_.begin(), parts_.end(), [](const auto& part) { return part->is_feasible(); });
  }

  std::vector<ArcId> chosen_arcs() const {
    std::vector<ArcId> arcs = split_.taken;
    for (const auto& part : parts_) {
      for (const ArcId a : part->state().best.arcs)
        arcs.push_back(core::original_arc(part->component().graph, a));
    }
    std::vector<std::vector<bool>> used;
    for (const auto& alone : split_.alone) used.emplace_back(alone.size(), false);
    for (const std::vector<Index>& tuple : rest_->solutions.front().arcs) {
      arcs.push_back(split_.rest_arc[*split_.rest->find(tuple)]);
      for (std::size_t k = 0; k < tuple.size(); ++k) used[k][tuple[k]] = true;
    }
    for (std::size_t k = 0; k < used.size(); ++k) {
      for (std::size_t i = 1; i < used[k].size(); ++i) {
        if (!used[k][i] && split_.alone[k][i] != bounded::Split::kNoArc)
          arcs.push_back(split_.alone[k][i]);
      }
    }
    return arcs;
  }

  void merge_multipliers(Solution& solution) const {
    for (std::size_t k = 0; k < split_.charge.size(); ++k) {
      std::vector<double>& u =
          solution.multipliers.emplace_back(split_.charge[k].begin() + 1, split_.charge[k].end());
      for (std::size_t i = 0; i < u.size(); ++i) {
        if (split_.in_rest[k][i + 1] != 0 && !rest_->multipliers.empty())
          u[i] = rest_->multipliers[k][i];
      }
    }
    for (const auto& part : parts_) {
      const std::vector<double>& u = part->state().u;
      core::for_each_index(part->component().graph,
                           [&](std::uint32_t slot, std::size_t k, Index i) {
                             solution.multipliers[k][i - 1] = u[slot];
                           });
    }
  }

  bool is_complete() const {
    return rest_->proven && std::all_of(parts_.begin(), parts_.end(), [](const auto& part) {
             return part->state().complete;
           });
  }

  bool is_on_grid() const {
    return std::all_of(
        parts_.begin(), parts_.end(), [](const auto& part) { return part->on_grid(); });
  }

  // Integers are added without error.
  void merge_bounds(Solution& solution) const {
    const double certificate = solution.stats.certificate_bound;
    const bool exact = !solution.solutions.empty() && is_complete() && is_on_grid() && grid_.exact;
    const double searched = exact ? solution.cost : total(false) - error();
    solution.lower_bound = std::min(std::max(certificate, searched), solution.cost);
    const bool is_zero = solution.cost == 0 && solution.lower_bound == 0;
    if (!is_zero && !solution.solutions.empty() &&
        is_negligible(problem_, solution.cost - certificate, solution.cost))
      solution.lower_bound = std::min(certificate, solution.cost);
    solution.stats.bound_by_branching = solution.lower_bound > certificate;
  }

  void set_status(Solution& solution) const {
    if (solution.solutions.empty()) {
      solution.status = why_stopped();
      return;
    }
    const double open = solution.cost - solution.stats.certificate_bound;
    if (is_complete() &&
        (is_on_grid() || is_negligible(problem_, std::min(2 * error(), open), solution.cost))) {
      solution.status = Status::kOptimal;
      solution.proven = solution.solutions.front().proven = true;
    } else if (is_complete() || rest_->status == Status::kPrecisionLost) {
      solution.status = Status::kPrecisionLost;
      solution.reason = rounding_reason(2 * error());
    } else if (options_.relative_gap > 0 && solution.relative_gap() <= options_.relative_gap) {
      solution.status = Status::kGapReached;
    } else {
      solution.status = why_stopped();
    }
  }

  // The gravest reason of what is not complete.
  Status why_stopped() const {
    for (const Status status : kReasonsToStop) {
      const auto stopped_so = [&](const auto& part) { return part->state().stopped == status; };
      if (rest_->status == status || std::any_of(parts_.begin(), parts_.end(), stopped_so))
        return status;
    }
    return deadline_.reached() ? out_of_time(deadline_) : Status::kGapReached;
  }

  void merge_stats(Solution& solution) const {
    solution.components = rest_->components;
    solution.stats = rest_->stats;
    for (const double cost : split_.taken_cost)
      solution.components.push_back({1, 0, Status::kOptimal, true, cost, cost, "reductions"});
    solution.stats.tried_components += split_.taken.size();
    solution.stats.settled_components += split_.taken.size();
    solution.stats.arcs_after_shift += split_.taken.size();
    solution.stats.arcs_after_fixing += split_.taken.size();
    solution.stats.arcs_left += split_.taken.size();
    for (const auto& part : parts_) {
      solution.components.push_back(part->report());
      const bounded::BoundedState& state = part->state();
      solution.stats.dual_evaluations += state.evaluations;
      solution.stats.recoveries += state.recoveries;
      solution.stats.nodes += state.nodes;
      solution.stats.arcs_after_shift += part->component().num_arcs();
      solution.stats.arcs_after_fixing += state.live_arcs;
      solution.stats.arcs_left += state.left_arcs;
    }
  }

  const Problem& problem_;
  const Options& options_;
  const WarmStart& warm_;
  const SolveOnce& solve_once_;
  Supervision supervision_;
  const core::Deadline& deadline_ = supervision_.deadline();
  Monitor& monitor_ = supervision_.monitor();
  core::CostGrid grid_;
  bounded::Split split_;
  std::vector<std::unique_ptr<BoundedPart>> parts_;
  std::optional<Solution> rest_;
  bool heard_ = false;     // a bound of the rest
  bool has_cost_ = false;  // the rest has a solution
  double heard_bound_ = 0;
  double heard_cost_ = 0;
};

// What parts with bounds would not follow is refused, not ignored.
void require_known_options(const Problem& problem, const Options& options) {
  const RelaxationOptions& relaxation = options.relaxation;
  const auto refuse = [&](bool is_asked, const char* who) {
    if (is_asked) core::require_single_uses(problem, who);
  };
  refuse(options.proof, "a proof");
  refuse(relaxation.set_order != SetOrder::kAsGiven, "option relaxation.set_order");
  refuse(relaxation.recovery_order != SetOrder::kAsGiven, "option relaxation.recovery_order");
  refuse(relaxation.alignment != AlignmentRule::kBestValue, "option relaxation.alignment");
  refuse(relaxation.inner_evaluations > 0, "option relaxation.inner_evaluations");
}

}  // namespace

Solution solve_many_to_one(const Problem& problem,
                           const Options& options,
                           const WarmStart& warm_start,
                           const SolveOnce& solve_once) {
  require_known_options(problem, options);
  return ManyToOne(problem, options, warm_start, solve_once).run();
}

}  // namespace nda::pipeline
