#include "assign2d/ranking.hpp"

#include <algorithm>
#include <cmath>

#include "assign2d/start.hpp"

namespace nda::lap {
namespace {

constexpr std::size_t kFirstReachRank = 24;
constexpr double kReachGrowth = 1.5;
constexpr double kNoise = 1e-12;  // of the largest cost

}  // namespace

// Among equals first what is to be listed, then small subsets.
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
  nodes_.assign(1, {0, kNone, kNone, kNone, 0, {}, 0, 0});
  at_ = 0;
  undivided_ = kNone;
  branches_.clear();
  forbidden_.clear();
  divided_.clear();
  queue_.assign(1, {0, 0, kNone});
  beyond_ = kInfinity;
}

bool Ranking::next(Assign2dResult& result) {
  if (undivided_ != kNone) {
    if (divided_.empty()) measure_rows();
    divide(undivided_);
    undivided_ = kNone;
  }
  while (!queue_.empty() || extend()) {
    if (queue_.empty()) continue;
    const Entry entry = take_first();
    if (entry.branch == kNone) {
      list(entry.node, result);
      return true;
    }
    solve_branch(entry.node, entry.branch);
  }
  return false;
}

void Ranking::list(std::uint32_t node, Assign2dResult& result) {
  move_to(node);
  state_.write(result);
  if (nodes_[node].branch != kNone) branches_[nodes_[node].branch].is_listed = true;
  undivided_ = node;
}

// A loss by each row of the best assignment, and with it the first reach.
void Ranking::measure_rows() {
  const std::uint32_t num_rows = problem_.num_rows();
  best_u_.resize(num_rows);
  best_v_.resize(problem_.num_columns());
  for (std::uint32_t i = 0; i < num_rows; ++i) best_u_[i] = state_.u(i);
  for (std::uint32_t j = 0; j < best_v_.size(); ++j) best_v_[j] = state_.v(j);
  search_.resize(num_rows, problem_.num_columns());
  subproblem_.resize(num_rows, problem_.num_columns());
  noise_ = kNoise * std::max({largest_magnitude(problem_.cost),
                              largest_magnitude(problem_.row_outside),
                              largest_magnitude(problem_.column_outside)});
  std::vector<double> leaving(num_rows, kInfinity), entering(best_v_.size());
  for (std::uint32_t j = 0; j < entering.size(); ++j) {
    entering[j] = problem_.column_outside[j] - best_v_[j];
  }
  for (std::uint32_t i = 0; i < num_rows; ++i) {
    const std::uint32_t held = state_.column_of_row(i);
    if (held != kNone) leaving[i] = problem_.row_outside[i] - best_u_[i];
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const std::uint32_t j = problem_.column[k];
      const double reduced = problem_.cost[k] - best_u_[i] - best_v_[j];
      if (j == held) continue;
      leaving[i] = reduced < leaving[i] ? reduced : leaving[i];
      entering[j] = reduced < entering[j] ? reduced : entering[j];
    }
  }
  row_losses_.clear();
  for (std::uint32_t i = 0; i < num_rows; ++i) {
    const std::uint32_t held = state_.column_of_row(i);
    const double loss = leaving[i] + (held == kNone ? 0 : entering[held]);
    if (loss < kInfinity) row_losses_.push_back(std::max(0.0, loss));
  }
  std::sort(row_losses_.begin(), row_losses_.end());
  reach_rank_ = std::min(kFirstReachRank, row_losses_.size());
  set_reach(reach_rank_ == 0 ? 0 : row_losses_[reach_rank_ - 1]);
}

void Ranking::set_reach(double reach) {
  reach_ = reach + noise_;
  core_.build(problem_, best_u_, best_v_, reach_);
}

// Looks further; false if there is nothing more.  Duals of the nodes stay right: those of a node
// moved by no more than its loss, so that pairs out of reach have no negative reduced cost there.
bool Ranking::extend() {
  const double least = std::min(beyond_, core_.next_reach());
  if (least == kInfinity) return false;
  reach_rank_ += std::max<std::size_t>(1, reach_rank_ / 2);
  const bool is_ranked = reach_rank_ <= row_losses_.size();
  set_reach(std::max(least, is_ranked ? row_losses_[reach_rank_ - 1] : kReachGrowth * reach_));
  beyond_ = kInfinity;
  for (const std::uint32_t node : divided_) judge_branches(node, nodes_[node].branches_begin);
  return true;
}

void Ranking::move_to(std::uint32_t node) {
  way_.clear();
  for (std::uint32_t goal = node; at_ != goal;) {
    if (at_ > goal) {
      state_.undo(nodes_[at_].changes);
      at_ = nodes_[at_].parent;
    } else {
      way_.push_back(goal);
      goal = nodes_[goal].parent;
    }
  }
  for (; !way_.empty(); way_.pop_back()) state_.redo(nodes_[way_.back()].changes);
  at_ = node;
}

void Ranking::append_open_rows(const Node& node) {
  if (node.branch == kNone) {
    for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) branches_.push_back({i, false});
    return;
  }
  const std::uint32_t end = nodes_[node.parent].branches_end;
  for (std::uint32_t n = node.branch; n < end; ++n) branches_.push_back({branches_[n].row, false});
}

// Puts rows that have nothing else to choose within reach first, then the others by descending
// loss, so that promising branches are small.  Returns where those begin.
std::uint32_t Ranking::sort_branches(const Node& node, std::uint32_t begin) {
  const std::uint32_t end = static_cast<std::uint32_t>(branches_.size());
  subproblem_.clear();
  for (std::uint32_t n = begin; n < end; ++n) subproblem_.open(branches_[n].row);
  subproblem_.open(state_.nobody());
  near_.clear();
  std::uint32_t near_begin = begin;
  for (std::uint32_t n = begin; n < end; ++n) {
    const std::uint32_t row = branches_[n].row;
    const double loss = node.loss + least_loss(state_, core_, subproblem_, row);
    if (loss <= reach_) {
      near_.push_back({loss, row, kNone});
    } else {
      beyond_ = std::min(beyond_, loss);
      branches_[near_begin++].row = row;
    }
  }
  std::sort(near_.begin(), near_.end(), [](const Entry& a, const Entry& b) {
    return a.loss != b.loss ? a.loss > b.loss : a.node < b.node;
  });
  for (std::uint32_t n = 0; n < near_.size(); ++n) branches_[near_begin + n].row = near_[n].node;
  return near_begin;
}

void Ranking::divide(std::uint32_t node) {
  move_to(node);
  Node& divided = nodes_[node];
  divided.branches_begin = static_cast<std::uint32_t>(branches_.size());
  append_open_rows(divided);
  divided.branches_end = static_cast<std::uint32_t>(branches_.size());
  divided_.push_back(node);
  const bool has_first = divided.row != kNone;
  judge_branches(node, sort_branches(divided, divided.branches_begin + (has_first ? 1 : 0)));
}

void Ranking::forbid(std::uint32_t row, std::uint32_t first) {
  for (std::uint32_t n = first; n != kNone; n = forbidden_[n].next) {
    subproblem_.forbid(row, forbidden_[n].choice);
  }
}

// The rows of this branch and the ones after it must be open.
void Ranking::judge_branch(std::uint32_t node, std::uint32_t branch) {
  const double loss =
      nodes_[node].loss + least_loss(state_, core_, subproblem_, branches_[branch].row);
  if (loss <= reach_) {
    wait({loss, node, branch});
  } else {
    beyond_ = std::min(beyond_, loss);
  }
}

// Branches from `begin` on, and the first of the node in any case.
void Ranking::judge_branches(std::uint32_t node, std::uint32_t begin) {
  move_to(node);
  const Node& divided = nodes_[node];
  subproblem_.clear();
  subproblem_.open(state_.nobody());
  if (divided.row != kNone) forbid(divided.row, divided.forbidden);
  for (std::uint32_t n = divided.branches_end; n > divided.branches_begin;) {
    subproblem_.open(branches_[--n].row);
    const bool is_first = divided.row != kNone && n == divided.branches_begin;
    if ((n >= begin || is_first) && !branches_[n].is_listed) judge_branch(node, n);
  }
}

void Ranking::solve_branch(std::uint32_t node, std::uint32_t branch) {
  move_to(node);
  const Node parent = nodes_[node];
  const std::uint32_t row = branches_[branch].row;
  const std::uint32_t held = state_.column_of_row(row);
  const std::uint32_t before = row == parent.row ? parent.forbidden : kNone;
  subproblem_.clear();
  subproblem_.open(state_.nobody());
  for (std::uint32_t n = branch; n < parent.branches_end; ++n) subproblem_.open(branches_[n].row);
  subproblem_.forbid(row, held);
  forbid(row, before);
  const RankingSearch::Outcome outcome =
      search_.choose_again(state_, core_, subproblem_, row, reach_ - parent.loss);
  const double loss = parent.loss + outcome.loss;
  if (!outcome.found) {
    beyond_ = std::min(beyond_, loss);
    return;
  }
  forbidden_.push_back({held, before});
  at_ = static_cast<std::uint32_t>(nodes_.size());
  const std::uint32_t first = static_cast<std::uint32_t>(forbidden_.size() - 1);
  nodes_.push_back({node, branch, row, first, loss, outcome.changes, 0, 0});
  wait({loss, at_, kNone});
}

}  // namespace nda::lap
