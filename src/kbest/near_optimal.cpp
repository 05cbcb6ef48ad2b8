#include "kbest/near_optimal.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/random.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "kbest/packing_buffer.hpp"
#include "kbest/packing_sums.hpp"
#include "kbest/partial_branch_and_bound.hpp"
#include "kbest/ranking_progress.hpp"
#include "kbest/ranks.hpp"
#include "recovery/core_search.hpp"
#include "solve/solutions.hpp"
#include "solve/supervision.hpp"

// The paper's solver has one component and one solution buffer.  Here every component of the
// problem has its own, which begins with what solve() found there, and the best sums of one packing
// of each are the answer.

namespace nda::kbest {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;

class NearOptimal {
 public:
  NearOptimal(const Problem& problem, Solution& solution, std::size_t k, const Options& options)
      : problem_(problem),
        solution_(solution),
        k_(k),
        options_(options),
        supervision_(ranking_progress(solution, options.progress),
                     options.stop,
                     options.time_limit_s - solution.stats.solve_seconds),
        deadline_(supervision_.deadline()),
        shift_(core::make_shift(problem, deadline_)) {
    for (const std::vector<Index>& tuple : solution.solutions.front().arcs)
      best_.push_back(static_cast<ArcId>(*problem.find(tuple)));
    is_searched_.assign(best_.size(), false);
  }

  void run() {
    const decompose::Partition partition = decompose::partition(problem_, shift_, deadline_);
    for (std::size_t c = 0; c < partition.num_components() && !deadline_.reached(); ++c) {
      lists_.push_back(rank(cutter_.cut(problem_, shift_, partition.component(c)), c));
    }
    lists_.push_back({unsearched()});
    take(solutions());
    solution_.stats.solve_seconds += deadline_.seconds();
  }

 private:
  // In arcs of the problem.
  std::vector<Packing> rank(const Component& component, std::size_t c) {
    PackingBuffer buffer(k_);
    Packing first = found_before(component);
    const double before = first.cost;
    buffer.add(std::move(first));
    PartialBranchAndBound search(options_, k_, deadline_);
    const std::vector<double> u = multipliers(component);
    std::vector<Packing> found = search.rank(component, u);
    if (options_.ranking.local_search) improve(component, u, found, buffer);
    buffer.add_best(std::move(found), deadline_);
    solution_.stats.dual_evaluations += search.work().evaluations;
    solution_.stats.recoveries += search.work().leaves;
    solution_.stats.nodes += search.work().branches;
    std::vector<Packing> packings = buffer.take(deadline_);
    if (c < solution_.components.size())
      solution_.components[c].cost += packings.front().cost - before;
    for (Packing& packing : packings) {
      for (ArcId& a : packing.arcs) a = component.arc_origin[a];
    }
    return packings;
  }

  // Adds what local search makes of each packing.
  void improve(const Component& component,
               std::span<const double> u,
               std::span<const Packing> packings,
               PackingBuffer& buffer) const {
    recovery::CoreSearchOptions options;
    options.kicks_per_index = options_.search.kicks_per_index;
    core::Random random(options_.seed);
    const double lower = std::accumulate(u.begin(), u.end(), 0.0);
    for (const Packing& packing : packings) {
      if (deadline_.reached()) return;
      buffer.add(recovery::search_core(
          component, u, packing.cost - lower, packing, options, random, deadline_));
    }
  }

  // What the solution has of a component, and notes that it was searched.
  Packing found_before(const Component& component) {
    const std::vector<ArcId> positions = core::positions_in(best_, component.arc_origin);
    for (const ArcId position : positions) is_searched_[position] = true;
    return core::make_packing(
        component, core::positions_in(component.arc_origin, core::at_positions(best_, positions)));
  }

  // What it has of the components that there was no time for.  The cost makes no difference.
  Packing unsearched() const {
    Packing rest;
    for (std::size_t n = 0; n < best_.size(); ++n) {
      if (!is_searched_[n]) rest.arcs.push_back(best_[n]);
    }
    return rest;
  }

  std::vector<double> multipliers(const Component& component) const {
    std::vector<double> u(component.num_slots(), 0.0);
    core::for_each_index(component, [&](std::uint32_t slot, std::size_t k, Index i) {
      u[slot] = solution_.multipliers[k][i - 1] - shift_.base[k][i];
    });
    return u;
  }

  void take(std::vector<RankedSolution> ranks) {
    if (ranks.empty()) return;  // all leave something uncovered
    adopt(problem_, solution_, std::move(ranks));
  }

  std::vector<RankedSolution> solutions() const {
    std::vector<RankedSolution> ranks;
    for (const PackingChoice& choice : cheapest_choices(lists_, k_, deadline_)) {
      if (ranks.size() >= kFewPackings && deadline_.reached()) break;
      std::vector<ArcId> arcs;
      for (const auto& [c, i] : choice)
        arcs.insert(arcs.end(), lists_[c][i].arcs.begin(), lists_[c][i].arcs.end());
      std::sort(arcs.begin(), arcs.end());
      const pipeline::Coverage covered = pipeline::coverage(problem_, arcs);
      RankedSolution next = pipeline::make_solution(problem_, arcs, covered);
      if (next.cost < kInfinity) ranks.push_back(std::move(next));
    }
    return ranks;
  }

  const Problem& problem_;
  Solution& solution_;
  const std::size_t k_;
  const Options& options_;
  pipeline::Supervision supervision_;
  const core::Deadline& deadline_;
  const core::Shift shift_;
  core::Cutter cutter_;
  std::vector<ArcId> best_;                  // of the solution, ascending
  std::vector<bool> is_searched_;            // [of best_]: its component
  std::vector<std::vector<Packing>> lists_;  // of each component
};

}  // namespace

void rank_near_optimal(const Problem& problem,
                       Solution& solution,
                       std::size_t k,
                       const Options& options) {
  NearOptimal(problem, solution, k, options).run();
}

}  // namespace nda::kbest
