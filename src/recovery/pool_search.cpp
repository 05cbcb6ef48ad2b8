#include "recovery/pool_search.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <utility>

#include "core/component.hpp"
#include "recovery/annealing_search.hpp"
#include "recovery/neighbourhood_search.hpp"
#include "recovery/rivals.hpp"
#include "recovery/slack_packing.hpp"
#include "recovery/swap_search.hpp"

// Construct, merge, solve (Blum et al. 2016).  Neighbourhood search alone ends in packings that no
// neighbourhood it can see through improves.  Others that started elsewhere are stuck as well, but
// in other places: the arcs of a dozen of them are a problem of a hundred or two, which is searched
// exactly, and its best packing is better than them all. Rounds go on four at a time, one of them
// from the best packing.  The arcs that may come in are those of small reduced cost, more and fewer
// in turn: the fewer, the larger the neighbourhoods.

namespace nda::recovery {
namespace {

constexpr double kWorkPerIndex = 5000;  // of a round
constexpr double kMergeShare = 0.5;     // of a round, for merging
constexpr double kSparse = 0.1;  // Rivals::density() below which annealing finds what swaps do not
constexpr double kAnnealingShare = 2.0 / 3;  // there, of the work for swaps
constexpr double kPopulations = 10;          // of annealed packings, one of them a tenth of that
constexpr double kSupportShare = 0.1;        // of all work, for merging what the relaxed point uses
constexpr std::size_t kPoolSize = 12;
constexpr std::size_t kRoundsAtOnce = 4;  // the first of them goes on from the best packing
constexpr double kBetter = 1e-9;
constexpr double kNoise = 0.05;      // of the gap, in the order of greedy packings
constexpr double kPriceShare = 0.1;  // an arc that covers dear indices comes earlier
constexpr std::array<double, 6> kMostReduced = {0.2, 0.4, 0.8, 0.3, 0.6, 1.0};  // of the best slack

using Arcs = std::vector<std::uint32_t>;

class PoolSearch {
 public:
  PoolSearch(const bnb::SlackProblem& problem,
             Arcs& best,
             const PoolSearchOptions& options,
             core::Random& random)
      : problem_(problem),
        best_(best),
        options_(options),
        random_(random),
        state_(problem),
        round_work_(std::max(options.least_round_work, kWorkPerIndex * problem.num_indices())) {
    state_.assign(best);
    best_slack_ = state_.slack();
  }

  void run() {
    if (problem_.num_arcs() == 0) return;
    merge(options_.support, kSupportShare * options_.max_work);
    if (options_.swap_work > 0 && !done()) swap();
    while (!done()) {
      const double left = (options_.max_work - work_) / round_work_;
      std::vector<Round> rounds;
      const auto count = static_cast<std::size_t>(std::clamp(left, 1.0, double{kRoundsAtOnce}));
      while (rounds.size() < count) rounds.push_back(next_round());
      while (searches_.size() < rounds.size()) searches_.emplace_back(problem_);
      options_.for_all(rounds.size(), [&](std::size_t r) {
        Round& round = rounds[r];
        round.work = searches_[r].improve(round.packing, round.limits, round.random);
      });
      for (Round& round : rounds) {
        work_ += round.work + problem_.num_rows();
        keep(std::move(round.packing));
      }
      merge_pool();
    }
  }

 private:
  struct Round {
    Arcs packing;
    NeighbourhoodSearch::Limits limits;
    core::Random random;
    double work = 0;
  };

  Round next_round() {
    const bool fresh = round_ % kRoundsAtOnce != 0 || next_start_ < options_.starts.size();
    Round round{fresh ? construct() : best_, {}, core::Random(random_())};
    round.limits.max_work = std::min(round_work_, options_.max_work - work_);
    round.limits.goal = options_.goal;
    round.limits.most_reduced = kMostReduced[round_ % kMostReduced.size()] * best_slack_;
    round.limits.deadline = options_.deadline;
    round.limits.for_all = options_.for_all;
    ++round_;
    return round;
  }

  void swap() {
    const Rivals rivals(problem_);
    work_ += rivals.work();
    const double annealing_work =
        rivals.density() < kSparse ? kAnnealingShare * options_.swap_work : 0;
    SwapSearch swaps(rivals);
    run_until(work_ + options_.swap_work - annealing_work, [&](double work) {
      return swaps.run({work, kPoolSize, options_.deadline}, random_, keep_found_);
    });
    AnnealingSearch annealing(rivals);
    run_until(work_ + annealing_work, [&](double work) {
      const double most = std::min(work, annealing_work / kPopulations);
      return annealing.run({most, options_.deadline}, random_, keep_found_);
    });
  }

  // search(most work) returns the work it took, 0 where there is nothing to search.
  template <typename Search>
  void run_until(double end, Search&& search) {
    end = std::min(end, options_.max_work);
    for (double work = 1; work > 0 && work_ < end && !done();) {
      work = search(end - work_);
      work_ += work;
      merge_pool();
    }
  }

  double gap() const { return best_slack_ - std::max(0.0, options_.goal); }

  bool done() const {
    return work_ >= options_.max_work || best_slack_ <= options_.goal ||
           options_.deadline.reached();
  }

  void keep(Arcs packing) {
    state_.assign(packing);
    if (state_.slack() < best_slack_ * (1 - kBetter)) {
      best_ = packing;
      best_slack_ = state_.slack();
    }
    pool_.push_back(std::move(packing));
    if (pool_.size() > kPoolSize) pool_.erase(pool_.begin());
  }

  Arcs construct() {
    if (next_start_ < options_.starts.size()) return options_.starts[next_start_++];
    return greedy();
  }

  // By reduced cost, what the indices cost if left uncovered, and chance.
  Arcs greedy() {
    if (greedy_key_.empty()) fill_greedy_keys();
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t arc = 0; arc < problem_.num_arcs(); ++arc)
      order.emplace_back(greedy_key_[arc] + random_.uniform(0, kNoise) * gap(), arc);
    work_ += static_cast<double>(order.size());
    std::sort(order.begin(), order.end());
    state_.assign({});
    for (const auto& [key, arc] : order) {
      if (state_.fits(arc)) state_.insert(arc);
    }
    return state_.arcs();
  }

  void fill_greedy_keys() {
    for (std::uint32_t arc = 0; arc < problem_.num_arcs(); ++arc) {
      double price = 0;
      for (const bnb::RowUse& use : problem_.index_uses(arc)) price += problem_.price(use.row);
      greedy_key_.push_back(problem_.reduced(arc) - kPriceShare * price);
    }
  }

  void merge_pool() {
    Arcs arcs;
    for (const Arcs& packing : pool_) arcs.insert(arcs.end(), packing.begin(), packing.end());
    merge(std::move(arcs), options_.max_work);
  }

  // The best packing of these arcs and those of the best one.
  void merge(Arcs arcs, double most_work) {
    arcs.insert(arcs.end(), best_.begin(), best_.end());
    std::sort(arcs.begin(), arcs.end());
    arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
    if (arcs.size() == best_.size() || done()) return;
    bnb::SlackProblem part(problem_.num_indices());
    for (std::uint32_t row = 0; row < problem_.num_rows(); ++row)
      part.add_row(problem_.price(row), problem_.capacity(row));
    for (const std::uint32_t arc : arcs) part.add_arc(problem_.reduced(arc), problem_.uses(arc));
    bnb::SlackLimits limits;
    limits.max_work = std::min({kMergeShare * round_work_, most_work, options_.max_work - work_});
    limits.deadline = options_.deadline;
    limits.for_all = options_.for_all;
    const bnb::SlackResult result = bnb::search_slack(part, best_slack_ * (1 - kBetter), limits);
    work_ += result.work + part.num_rows();
    if (!(result.slack < best_slack_)) return;
    Arcs merged = core::at_positions(arcs, result.arcs);
    std::sort(merged.begin(), merged.end());
    keep(std::move(merged));
  }

  const std::function<void(Arcs)> keep_found_ = [this](Arcs packing) { keep(std::move(packing)); };
  const bnb::SlackProblem& problem_;
  Arcs& best_;
  const PoolSearchOptions& options_;
  core::Random& random_;
  SlackPacking state_;
  std::deque<NeighbourhoodSearch> searches_;  // of rounds at once
  const double round_work_;
  double best_slack_ = 0;
  double work_ = 0;
  std::size_t round_ = 0;
  std::size_t next_start_ = 0;
  std::vector<Arcs> pool_;
  std::vector<double> greedy_key_;  // [arc], without chance
};

}  // namespace

void search_pool(const bnb::SlackProblem& problem,
                 std::vector<std::uint32_t>& best,
                 const PoolSearchOptions& options,
                 core::Random& random) {
  PoolSearch(problem, best, options, random).run();
}

}  // namespace nda::recovery
