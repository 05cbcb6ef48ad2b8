#include "assign2d/ranking.hpp"

#include <algorithm>
#include <cmath>

#include "assign2d/start.hpp"

namespace nda::lap {
namespace {

constexpr int kTunings = 3;        // more find little to do
constexpr int kFirstTunings = 8;   // once for the whole tree
constexpr double kFirstReach = 4;  // times the loss of the second best
constexpr double kGrowth = 1.5;
constexpr double kFastGrowth = 3;
constexpr std::size_t kFewNodes = 16;
constexpr double kNoise = 1e-11;  // of the largest cost

}  // namespace

// Among equals first what has been solved, then small subsets.
bool Ranking::is_later(const Entry& a, const Entry& b) {
  if (a.loss != b.loss) return a.loss > b.loss;
  return a.branch != b.branch ? a.branch < b.branch : a.node > b.node;
}

void Ranking::wait(const Entry& entry) {
  queue_.push_back(entry);
  std::push_heap(queue_.begin(), queue_.end(), is_later);
}

Ranking::Entry Ranking::take_first() {
  std::pop_heap(queue_.begin(), queue_.end(), is_later);
  const Entry first = queue_.back();
  queue_.pop_back();
  return first;
}

void Ranking::start(const Assign2dProblem& problem, const Assign2dResult& best) {
  problem_ = problem;
  state_.start(problem, best);
  reach_ = -1;
  listed_reach_ = -1;
  at_reach_.clear();
  at_listed_.clear();
  begin_tree();
}

// The state must be at the best assignment.
void Ranking::begin_tree() {
  nodes_.assign(1, {0, kNone, kNone, kNone, 0, {}, {}, 0, 0});
  branches_.clear();
  forbidden_.clear();
  queue_.assign(1, {0, 0, kNone});
  at_ = 0;
  undivided_ = kNone;
  beyond_ = kInfinity;
}

bool Ranking::next(Assign2dResult& result) {
  while (true) {
    if (undivided_ != kNone) {
      if (reach_ < 0) prepare();
      divide(undivided_);
      undivided_ = kNone;
    }
    if (queue_.empty() && !extend()) return false;
    const Entry entry = take_first();
    if (entry.branch != kNone) {
      solve_branch(entry.node, entry.branch);
      continue;
    }
    move_to(entry.node);
    undivided_ = entry.node;
    if (was_listed()) continue;
    state_.write(result);
    if (entry.loss > reach_ - noise_ && reach_ >= 0) at_reach_.push_back(result);
    return true;
  }
}

// Whether a former tree listed the assignment of the state.
bool Ranking::was_listed() {
  const double loss = nodes_[at_].loss;
  if (loss < listed_reach_ - noise_) return true;
  if (loss > listed_reach_ + noise_) return false;
  Assign2dResult result;
  state_.write(result);
  return std::any_of(at_listed_.begin(), at_listed_.end(), [&](const Assign2dResult& listed) {
    return listed.column_of_row == result.column_of_row;
  });
}

// Pairs of the core and the first reach, which is that of the losses of a few rows.
void Ranking::prepare() {
  best_u_.assign(state_.u().begin(), state_.u().end());
  best_v_.assign(state_.v().begin(), state_.v().end());
  search_.resize(problem_.num_rows(), problem_.num_columns());
  subproblem_.resize(problem_.num_rows(), problem_.num_columns());
  noise_ = kNoise * std::max({largest_magnitude(problem_.cost),
                              largest_magnitude(problem_.row_outside),
                              largest_magnitude(problem_.column_outside)});
  core_.start(problem_, best_u_, best_v_);
  core_.build_widely(4 * noise_);
  subproblem_.clear();
  open_rows(nodes_[0]);
  for (int n = 0; n < kFirstTunings; ++n) tune(kInfinity, false);
  std::sort(open_.begin(), open_.end(), [](const RowLoss& a, const RowLoss& b) {
    return a.loss != b.loss ? a.loss < b.loss : a.row < b.row;
  });
  reach_ = kFirstReach * second_loss() + 4 * noise_;
  core_.build(reach_);
}

// The loss of the second best assignment: the least of what the rows lose by choosing again.  0 if
// there is none.
double Ranking::second_loss() {
  double least = kInfinity;
  for (const RowLoss& open : open_) {
    if (!(open.loss < least)) break;
    subproblem_.allow();
    subproblem_.forbid(open.row, state_.column_of_row(open.row));
    const RankingSearch::Outcome outcome =
        search_.choose_again(state_, core_, subproblem_, open.row, least);
    if (!outcome.found) continue;
    least = outcome.loss;
    state_.drop(outcome.changes);
  }
  return least < kInfinity ? least : 0;
}

// Begins another tree that reaches further; false if there is nothing more.
bool Ranking::extend() {
  const double least = std::min(beyond_, core_.next_reach());
  if (least == kInfinity) return false;
  const double growth = nodes_.size() < kFewNodes ? kFastGrowth : kGrowth;
  listed_reach_ = reach_;
  reach_ = std::max(least, growth * reach_) + 4 * noise_;
  at_listed_.swap(at_reach_);
  at_reach_.clear();
  move_to(0);
  state_.undo(nodes_[0].tuning);
  state_.forget_log();
  core_.build(reach_);
  begin_tree();
  return true;
}

void Ranking::move_to(std::uint32_t node) {
  way_.clear();
  for (std::uint32_t goal = node; at_ != goal;) {
    if (at_ > goal) {
      state_.undo(nodes_[at_].tuning);
      state_.undo(nodes_[at_].changes);
      at_ = nodes_[at_].parent;
    } else {
      way_.push_back(goal);
      goal = nodes_[goal].parent;
    }
  }
  for (; !way_.empty(); way_.pop_back()) {
    state_.redo(nodes_[way_.back()].changes);
    state_.redo(nodes_[way_.back()].tuning);
  }
  at_ = node;
}

// Lists the rows that may choose again in a node; the first is that which did for it.
void Ranking::open_rows(const Node& node) {
  open_.clear();
  if (node.row == kNone) {
    for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) open_.push_back({0, i});
  } else {
    const std::uint32_t end = nodes_[node.parent].branches_end;
    for (std::uint32_t n = node.branch; n < end; ++n) open_.push_back({0, branches_[n]});
  }
  for (const RowLoss& open : open_) subproblem_.open(open.row);
}

// One round over the open rows: those that lose more than `spare` by any other choice are closed,
// the duals of the others are moved so that leaving and entering cost the same.
void Ranking::tune(double spare, bool is_logged) {
  std::size_t num_kept = 0;
  for (const RowLoss& open : open_) {
    const LeastLoss loss = least_loss(state_, core_, subproblem_, open.row);
    if (loss.sum() > spare) {
      beyond_ = std::min(beyond_, reach_ - spare + loss.sum());
      subproblem_.close(open.row);
      continue;
    }
    open_[num_kept++] = {loss.sum(), open.row};
    const double shift = (loss.leaving - loss.entering) / 2;
    if (is_logged) state_.log_price(open.row);
    if (std::abs(shift) < kInfinity) state_.shift_dual(open.row, shift);
  }
  open_.resize(num_kept);
}

// That of the row which chose again first, so that no other branch has anything forbidden; then by
// descending loss, so that promising branches are small.
void Ranking::append_branches(const Node& node) {
  const bool has_first = !open_.empty() && open_.front().row == node.row;
  std::sort(open_.begin() + has_first, open_.end(), [](const RowLoss& a, const RowLoss& b) {
    return a.loss != b.loss ? a.loss > b.loss : a.row < b.row;
  });
  for (const RowLoss& open : open_) branches_.push_back(open.row);
}

void Ranking::divide(std::uint32_t node) {
  move_to(node);
  Node& divided = nodes_[node];
  subproblem_.clear();
  forbid(divided.row, divided.forbidden);
  open_rows(divided);
  divided.tuning = state_.open_range();
  for (int n = 0; n < kTunings; ++n) tune(reach_ - divided.loss, n == 0);
  state_.close_range(divided.tuning);
  divided.branches_begin = static_cast<std::uint32_t>(branches_.size());
  append_branches(divided);
  divided.branches_end = static_cast<std::uint32_t>(branches_.size());
  judge_branches(node);
}

void Ranking::forbid(std::uint32_t row, std::uint32_t first) {
  for (std::uint32_t n = first; n != kNone; n = forbidden_[n].next) {
    subproblem_.forbid(row, forbidden_[n].choice);
  }
}

// The last branch has only its own row open, the first has all.
void Ranking::judge_branches(std::uint32_t node) {
  const Node& divided = nodes_[node];
  subproblem_.clear();
  forbid(divided.row, divided.forbidden);
  for (std::uint32_t n = divided.branches_end; n > divided.branches_begin;) {
    const std::uint32_t row = branches_[--n];
    subproblem_.open(row);
    const double loss = divided.loss + least_loss(state_, core_, subproblem_, row).sum();
    if (loss <= reach_) {
      wait({loss, node, n});
    } else {
      beyond_ = std::min(beyond_, loss);
    }
  }
}

void Ranking::solve_branch(std::uint32_t node, std::uint32_t branch) {
  move_to(node);
  const Node parent = nodes_[node];
  const std::uint32_t row = branches_[branch];
  const std::uint32_t held = state_.column_of_row(row);
  const std::uint32_t before = row == parent.row ? parent.forbidden : kNone;
  subproblem_.clear();
  for (std::uint32_t n = branch; n < parent.branches_end; ++n) subproblem_.open(branches_[n]);
  subproblem_.forbid(row, held);
  forbid(row, before);
  const RankingSearch::Outcome outcome =
      search_.choose_again(state_, core_, subproblem_, row, reach_ - parent.loss);
  const double loss = parent.loss + outcome.loss;
  if (!outcome.found) {
    beyond_ = std::min(beyond_, loss);
    return;
  }
  const std::uint32_t first = static_cast<std::uint32_t>(forbidden_.size());
  forbidden_.push_back({held, before});
  at_ = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({node, branch, row, first, loss, outcome.changes, {}, 0, 0});
  wait({loss, at_, kNone});
}

}  // namespace nda::lap
