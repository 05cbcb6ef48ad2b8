#include "nda/k_best.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/shift.hpp"
#include "decompose/components.hpp"
#include "kbest/combinations.hpp"
#include "kbest/near_optimal.hpp"
#include "kbest/part.hpp"
#include "kbest/slack_view.hpp"
#include "nda/solve.hpp"
#include "solve/component_solver.hpp"
#include "solve/costs.hpp"
#include "solve/monitor.hpp"

// Exact ranking by a threshold.  With the multipliers of the best solution every cost is a constant
// plus slack: reduced costs of the arcs used, prices of the indices left alone, all >= 0.
//
//   1. Solutions that differ from the best by one arc are all different, so the (k - 1)-th best of
//      them bounds rank k: it costs at most so much more than the best.
//   2. Arcs of larger reduced cost are in no solution of these ranks; those that cost no less than
//      leaving their indices alone, which the best can do without, may be.
//   3. What is left falls apart.  The best solution is best in every part, so nothing in a part
//      costs more than that `reach` above it, either: a budget for the ranking of the part.
//   4. The k best sums of one packing of each part are found lazily.
//
// Solutions multiply where differences combine, so the bound of 1 is far too high for large k.  The
// reach starts at the few neighbours whose combinations might be k, and grows until there are k.
// What is found within a reach is proven, whatever becomes of the next.
//
// Source of 1 and 2: reduced-cost fixing, against the k-th value; of 4: Lawler (1972).

namespace nda {
namespace {

using core::ArcId;
using kbest::Combinations;
using kbest::Part;
using kbest::RankedList;
using kbest::SlackView;

constexpr double kGrowth = 1.5;  // of the number of neighbours within reach

class Ranker {
 public:
  Ranker(const Problem& problem, Solution& solution, std::size_t k, const Options& options)
      : problem_(problem),
        solution_(solution),
        k_(k),
        max_nodes_(options.branch.max_nodes),
        forward_stop_(options.stop, pipeline::StopForwarder{stop_}),
        monitor_(progress_of(solution, options), stop_),
        deadline_(
            options.time_limit_s - solution.stats.solve_seconds, stop_.get_token(), &heartbeat_),
        view_(problem, solution),
        neighbours_(view_.neighbours(k - 1, deadline_)) {}

  void run() {
    std::vector<RankedSolution> ranks = {solution_.solutions.front()};
    if (ranks.front().proven && !deadline_.reached()) {
      split();
      for (std::size_t within = first_within(); widen(within);)
        within = static_cast<std::size_t>(kGrowth * static_cast<double>(within)) + 1;
      if (!list_.empty()) ranks = proven();
    }
    if (!is_complete_) add_neighbours(ranks);
    for (std::size_t r = 0; r < ranks.size(); ++r) ranks[r].rank = static_cast<int>(r) + 1;
    solution_.solutions = std::move(ranks);
    solution_.stats.solve_seconds += deadline_.seconds();
  }

 private:
  // What the user is told while solutions are ranked.
  static std::function<bool(const Progress&)> progress_of(const Solution& solution,
                                                          const Options& options) {
    if (!options.progress) return nullptr;
    const std::size_t components = solution.num_components;
    const Progress solved = {solution.stats.solve_seconds,
                             solution.cost,
                             solution.lower_bound,
                             components,
                             components,
                             "ranking"};
    return [solved, &options](const Progress& now) {
      Progress ranking = solved;
      ranking.seconds += now.seconds;
      return options.progress(ranking);
    };
  }

  // As many neighbours as have k combinations, if no two exclude each other, and as many again.
  std::size_t first_within() const {
    return 2 * static_cast<std::size_t>(std::ceil(std::log2(static_cast<double>(k_))));
  }

  // What the first neighbours cost more than the best; without enough of them, what anything can.
  double reach(std::size_t within) const {
    const std::size_t last = std::min(within, k_ - 1);
    if (last <= neighbours_.size()) return std::max(0.0, neighbours_[last - 1].rise);
    double all = 0;
    for (const Part& part : parts_) all += part.all();
    return all;
  }

  // What is left of the problem within the reach of rank k, in parts.
  void split() {
    const double most = neighbours_.size() + 1 < k_ ? kInfinity : reach(k_ - 1);
    const core::Shift shift = core::make_shift(problem_);
    const double largest = pipeline::largest_cost(problem_);
    error_ = pipeline::precision_of(problem_.num_indices(), largest, {}).error;
    const double budget = kbest::beyond(view_.slack() + most, error_);
    std::vector<ArcId> near;
    for (ArcId a = 0; a < problem_.num_arcs(); ++a) {
      if (view_.reduced(a) < budget) near.push_back(a);
    }
    core::Cutter cutter;
    const core::Component whole = cutter.cut(problem_, shift, near);
    const decompose::Partition partition = decompose::partition(whole);
    for (std::size_t p = 0; p < partition.num_components() && !deadline_.reached(); ++p) {
      parts_.emplace_back(cutter.cut(whole, partition.component(p)), view_);
      if (shift.penalty == 0) parts_.back().tighten(deadline_);
    }
  }

  // Ranks all solutions within the reach of so many neighbours.  Returns whether there is more to
  // do.
  bool widen(std::size_t within) {
    if (deadline_.reached()) return false;
    const double reach = this->reach(within);
    double least = 0;
    Combinations combinations;
    RankedList list = {{0, kbest::kNothing}};
    for (const Part& part : parts_) {
      bnb::SlackLimits limits;
      limits.deadline = deadline_;
      limits.max_nodes = max_nodes_ - solution_.stats.nodes;
      const kbest::SlackRanking found = part.rank(reach, k_, limits, combinations);
      solution_.stats.nodes += found.nodes;
      if (!found.complete) return false;
      least += part.least();
      list = kbest::combine_ranked(list, found.packings, k_, kInfinity, combinations);
    }
    // Sums beyond the reach may lack others that are as good.
    const double budget = kbest::beyond(least + reach, error_);
    std::erase_if(list, [&](const kbest::Ranked& ranked) { return ranked.slack > budget; });
    list_ = std::move(list);
    combinations_ = std::move(combinations);
    is_complete_ = list_.size() >= k_ || within >= std::min(k_ - 1, neighbours_.size() + 1);
    return !is_complete_;
  }

  std::vector<RankedSolution> proven() const {
    std::vector<RankedSolution> ranks;
    for (const kbest::Ranked& ranked : list_) {
      ranks.push_back(view_.solution_of(combinations_.arcs(ranked.arcs)));
      ranks.back().proven = true;
    }
    sort(ranks, 0);
    return ranks;
  }

  // Those that are not among the proven ones.
  void add_neighbours(std::vector<RankedSolution>& ranks) const {
    const std::size_t before = ranks.size();
    for (const SlackView::Neighbour& neighbour : neighbours_) {
      RankedSolution next = view_.solution_of(view_.arcs_of(neighbour));
      const auto is_same = [&](const RankedSolution& rank) { return rank.arcs == next.arcs; };
      if (std::any_of(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(before), is_same))
        continue;
      ranks.push_back(std::move(next));
    }
    sort(ranks, before);
    if (ranks.size() > k_) ranks.resize(k_);
  }

  static void sort(std::vector<RankedSolution>& ranks, std::size_t first) {
    std::stable_sort(
        ranks.begin() + static_cast<std::ptrdiff_t>(first),
        ranks.end(),
        [](const RankedSolution& a, const RankedSolution& b) { return a.cost < b.cost; });
  }

  const Problem& problem_;
  Solution& solution_;
  const std::size_t k_;
  const std::int64_t max_nodes_;
  std::stop_source stop_;
  std::stop_callback<pipeline::StopForwarder> forward_stop_;
  pipeline::Monitor monitor_;
  const std::function<void()> heartbeat_ = [this] { monitor_.heartbeat(); };
  const core::Deadline deadline_;
  const SlackView view_;
  const std::vector<SlackView::Neighbour> neighbours_;
  double error_ = 0;  // of rounding
  std::vector<Part> parts_;
  Combinations combinations_;
  RankedList list_;  // what is proven
  bool is_complete_ = false;
};

}  // namespace

Solution solve_k_best(const Problem& problem, std::size_t k, const Options& options) {
  if (k == 0) throw InputError("k is 0; at least 1 solution must be asked for");
  Solution solution = solve(problem, options);
  if (solution.solutions.empty()) return solution;
  if (options.ranking.method != RankingMethod::kExact) {
    kbest::rank_near_optimal(problem, solution, k, options);
  } else if (k > 1) {
    Ranker(problem, solution, k, options).run();
  }
  return solution;
}

std::size_t num_proven(const Solution& solution) {
  const auto& ranks = solution.solutions;
  const auto end = std::find_if_not(
      ranks.begin(), ranks.end(), [](const RankedSolution& rank) { return rank.proven; });
  return static_cast<std::size_t>(end - ranks.begin());
}

}  // namespace nda
