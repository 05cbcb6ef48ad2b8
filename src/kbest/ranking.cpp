#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "kbest/ranker.hpp"
#include "kbest/ranking_progress.hpp"
#include "nda/k_best.hpp"
#include "nda/solve.hpp"
#include "solve/process.hpp"
#include "solve/supervision.hpp"

// Ranks are listed some at a time, twice as many as were given: every search then finds as many as
// all before it, so what it does again of them adds up to little.
//
// Where a limit leaves the best solution unproven it is not given: the next one might be better.
// Where something else does, as a gap that was asked for, no later call can change it.

namespace nda {
namespace {

constexpr std::size_t kFirstPlanned = 10;

bool is_limit(Status status) {
  return status == Status::kTimeLimit || status == Status::kNodeLimit ||
         status == Status::kInterrupted;
}

Status limit_of(const core::Deadline& deadline) {
  if (deadline.interrupted()) return Status::kInterrupted;
  return deadline.expired() ? Status::kTimeLimit : Status::kNodeLimit;
}

}  // namespace

class Ranking::State {
 public:
  State(const Problem& problem, const Options& options) : problem_(problem), options_(options) {}

  const Options& options() const { return options_; }
  const Solution& solution() const { return solution_; }
  Status status() const { return status_; }

  bool next(RankedSolution& next, const Options& options) {
    if (!has_next() && !find(options)) return false;
    next = given_ == 0             ? solution_.solutions.front()
           : given_ < num_listed() ? ranker_->listed()[given_]
                                   : others_[given_ - num_listed()];
    next.rank = static_cast<int>(++given_);
    status_ = solution_.status;
    return true;
  }

  std::vector<RankedSolution> at_hand(std::size_t count) {
    std::vector<RankedSolution> found;
    if (!ranker_) return found;
    ranker_->list(1, kFirstPlanned, {});  // lists the best one, if nothing was listed yet
    const auto add = [&](const std::vector<RankedSolution>& from, std::size_t first) {
      for (std::size_t r = first; r < from.size() && found.size() < count; ++r)
        found.push_back(from[r]);
    };
    add(ranker_->listed(), given_);
    add(others_, std::max(given_, num_listed()) - num_listed());
    add(ranker_->unlisted(others_.size(), count - found.size(), {}), 0);
    for (std::size_t r = 0; r < found.size(); ++r) {
      found[r].rank = static_cast<int>(given_ + r) + 1;
      found[r].proven = false;
    }
    return found;
  }

 private:
  std::size_t num_listed() const { return ranker_ ? ranker_->listed().size() : 0; }

  // It is found already.
  bool has_next() const {
    if (is_open() || !ranker_) return false;
    return given_ == 0 || given_ < num_listed() + others_.size();
  }

  // Not solved, or not to the end.
  bool is_open() const { return !solution_.proven && is_limit(solution_.status); }

  // One more at least.
  bool find(const Options& options) {
    double seconds = 0;
    if (is_open()) {
      ranker_.reset();
      solution_ = solve(problem_, options);
      seconds = solution_.stats.solve_seconds;
      if (!solution_.solutions.empty()) ranker_ = kbest::make_ranker(problem_, solution_);
    } else {
      validate(options);
    }
    status_ = solution_.status;
    if (!ranker_ || is_open()) return false;
    if (has_next()) return true;
    pipeline::Supervision supervision(kbest::ranking_progress(solution_, options.progress),
                                      options.stop,
                                      options.time_limit_s - seconds);
    const std::int64_t nodes = ranker_->nodes();
    const bool found = list({options.branch.max_nodes, supervision.deadline()});
    solution_.stats.nodes += ranker_->nodes() - nodes;
    solution_.stats.solve_seconds += supervision.deadline().seconds();
    solution_.stats.peak_memory_bytes = pipeline::peak_memory_bytes();
    return found;
  }

  bool list(const kbest::RankLimits& limits) {
    const std::size_t planned = std::max(kFirstPlanned, 2 * given_);
    const std::size_t enough = solution_.proven ? given_ + 1 : 1;
    const bool is_whole = ranker_->list(enough, planned, limits);
    if (!solution_.proven && is_whole)
      std::ranges::move(ranker_->unlisted(others_.size(), planned, limits.deadline),
                        std::back_inserter(others_));
    if (has_next()) return true;
    if (!is_whole || limits.deadline.reached()) status_ = limit_of(limits.deadline);
    return false;
  }

  const Problem& problem_;
  const Options options_;
  Solution solution_;  // "interrupted" until it is solved
  Status status_ = Status::kInterrupted;
  std::unique_ptr<kbest::Ranker> ranker_;
  std::vector<RankedSolution> others_;  // beside the best one, where that is not proven
  std::size_t given_ = 0;
};

Ranking::Ranking(const Problem& problem, const Options& options) {
  validate(options);
  state_ = std::make_unique<State>(problem, options);
}

Ranking::Ranking(Ranking&& other) noexcept = default;
Ranking& Ranking::operator=(Ranking&& other) noexcept = default;
Ranking::~Ranking() = default;

bool Ranking::next(RankedSolution& solution) {
  return state_ != nullptr && state_->next(solution, state_->options());
}

bool Ranking::next(RankedSolution& solution, const Options& options) {
  return state_ != nullptr && state_->next(solution, options);
}

Status Ranking::status() const {
  return state_ != nullptr ? state_->status() : Status::kInterrupted;
}

const Solution& Ranking::solution() const {
  static const Solution none;
  return state_ != nullptr ? state_->solution() : none;
}

std::vector<RankedSolution> Ranking::at_hand(std::size_t count) const {
  return state_ != nullptr ? state_->at_hand(count) : std::vector<RankedSolution>{};
}

}  // namespace nda
