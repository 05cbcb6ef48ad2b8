#include "recovery/kept_solver.hpp"

#include <algorithm>
#include <cstdint>

#include "bnb/enumerate.hpp"
#include "core/reduced_costs.hpp"
#include "cutting/widening.hpp"
#include "recovery/greedy.hpp"
#include "recovery/packing_state.hpp"
#include "recovery/recursive.hpp"

// The relaxed problem is an assignment problem like any other, but hundreds of them come one after
// another, with the same arcs and costs that differ little.  So the last multipliers and the last
// packing, at the new costs, are where to start; near the maximum that often is the answer already.
// What is left is searched within the multipliers' slack, then by linear programs and cuts.
//
// Relaxation alone is what the report's authors had: n to n - 1 to n - 2 and so on, each level with
// its own multipliers, which go with the answer and come back with the next call.

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using relax::KeptAnswer;

constexpr int kSweeps = 2;
// Searches within the slack that take more are left to linear programs.
constexpr std::int64_t kEarlyNodes = 200;

// What sums of costs or multipliers may round off.
double rounding(const Component& problem) {
  return 0x1p-50 * static_cast<double>(problem.num_indices()) * core::largest_cost(problem);
}

class KeptSearch {
 public:
  KeptSearch(const Component& problem,
             const RelaxationOptions& options,
             const core::Deadline& deadline,
             KeptAnswer& answer)
      : problem_(problem),
        options_(options),
        deadline_(deadline),
        answer_(answer),
        error_(rounding(problem)) {}

  void run() {
    if (!start()) return;
    if (problem_.num_dimensions() > 2 && is_small()) {
      enumerate(kEarlyNodes);
      if (!answer_.exact) branch_and_cut();
    }
    if (!answer_.exact) relax();
  }

 private:
  // The last packing and multipliers at the new costs; false if out of time.
  bool start() {
    std::vector<ArcId> arcs;
    for (const ArcId a : answer_.best.arcs) {
      if (problem_.costs[a] < 0) arcs.push_back(a);
    }
    answer_.best = core::make_packing(problem_, std::move(arcs));
    answer_.exact = false;
    answer_.lower = -kInfinity;
    answer_.u.resize(problem_.num_slots(), 0.0);
    if (options_.kept_evaluations == 1) last_ = answer_.u;
    double lower = 0;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      lower = relax::make_feasible(problem_, answer_.u, deadline_);
    raise(lower - error_);
    return lower > -kInfinity && !answer_.exact;
  }

  bool is_small() const {
    const auto below_zero = [](double cost) { return cost < 0; };
    const auto count = std::count_if(problem_.costs.begin(), problem_.costs.end(), below_zero);
    return static_cast<std::size_t>(count) <= options_.kept_exact_arcs;
  }

  double cutoff() const { return answer_.best.cost - error_; }

  void offer(const Packing& packing) {
    if (packing.cost >= answer_.best.cost) return;
    answer_.best = packing;
    raise(answer_.lower);
  }

  // A bound, rounding taken off.
  void raise(double lower) {
    answer_.lower = std::max(answer_.lower, lower);
    answer_.exact = answer_.best.cost - answer_.lower <= 2 * error_;
  }

  void adopt(std::vector<double> u, double lower) {
    if (lower - error_ <= answer_.lower) return;
    answer_.u = std::move(u);
    raise(lower - error_);
  }

  void enumerate(std::int64_t max_nodes) {
    const bnb::SearchResult found = bnb::enumerate(
        problem_, answer_.u, cutoff(), std::min(max_nodes, options_.kept_nodes), deadline_);
    nodes_ += found.nodes;
    answer_.nodes += found.nodes;
    if (found.found) offer(found.best);
    if (found.complete) raise(cutoff());
  }

  // On the arcs that reduced costs leave, as a component of their own.
  void branch_and_cut() {
    std::vector<ArcId> live;
    core::for_each_reduced_cost(problem_, answer_.u, {}, [&](ArcId a, double r) {
      if (answer_.lower + r < cutoff()) live.push_back(a);
    });
    if (live.empty()) return raise(cutoff());
    core::Cutter cutter;
    const Component core = cutter.cut(problem_, live);
    cutting::WideningLimits limits;
    limits.cutoff = cutoff();
    limits.margin = error_;
    limits.max_nodes = options_.kept_nodes - nodes_;
    limits.context.deadline = deadline_;
    cutting::WideningObserver observer;
    observer.offer = [&](const cutting::Master& point, const Packing* found) {
      const Packing packing =
          found != nullptr ? *found : round_values(core, point.arcs(), point.values());
      offer({core::at_positions(live, packing.arcs), packing.cost});
      return cutoff();
    };
    observer.relaxed = [&](const cutting::Master& point) {
      std::vector<double> u = answer_.u;
      core::extend_slots(core, point.u(), problem_, u);
      const double lower = relax::make_feasible(problem_, u, deadline_);
      adopt(std::move(u), lower);
    };
    observer.improve = [&](cutting::Master&, const cutting::PrimalBudget&) { return cutoff(); };
    observer.raise = [&](double lower) { raise(std::min(lower, cutoff())); };
    const std::vector<double> u = core::restrict_slots(problem_, answer_.u, core);
    answer_.nodes += cutting::search_widening(core, u, limits, observer).nodes;
  }

  // Two dimensions: the relaxed problem is the problem.
  void relax() {
    relax::LagrangianOptions loop = relax::loop_options(options_, deadline_);
    loop.max_evaluations = problem_.num_dimensions() == 2 ? 1 : options_.kept_evaluations;
    loop.relative_tolerance = options_.relative_tolerance;
    loop.recovery_interval = problem_.num_dimensions() <= 3 ? 1 : 0;
    keep_sets(options_, deadline_, loop);
    const auto recover = [&](const relax::RelaxedDual& point) {
      return recover_recursively(problem_, point, options_, deadline_);
    };
    const std::vector<double>& start = last_.empty() ? answer_.u : last_;
    const relax::LagrangianResult found = relax::maximize_dual(problem_, start, loop, recover);
    answer_.evaluations += found.evaluations + found.kept_evaluations;
    answer_.nodes += found.kept_nodes;
    adopt(found.u, found.lower);
    offer(found.best);
    raise(found.kept_bound);
  }

  const Component& problem_;
  const RelaxationOptions& options_;
  const core::Deadline& deadline_;
  KeptAnswer& answer_;
  const double error_;
  // Where a single evaluation takes place: the multipliers as they were.  At feasible ones nothing
  // gains, so that it would find the empty packing.
  std::vector<double> last_;
  std::int64_t nodes_ = 0;
};

}  // namespace

relax::KeptSolver make_kept_solver(const RelaxationOptions& options,
                                   const core::Deadline& deadline) {
  return [options, deadline](const Component& problem, KeptAnswer& answer) {
    KeptSearch(problem, options, deadline, answer).run();
  };
}

void keep_sets(const RelaxationOptions& options,
               const core::Deadline& deadline,
               relax::LagrangianOptions& loop) {
  loop.kept.num_kept = options.kept_sets;
  loop.kept.merit = options.merit;
  loop.kept.decompose = options.decompose;
  if (options.kept_sets > 2) loop.kept.solve = make_kept_solver(options, deadline);
}

}  // namespace nda::recovery
