#include "assign2d/ranking.hpp"

#include <algorithm>

#include "assign2d/start.hpp"

// Murty, "An algorithm for ranking all the assignments in order of increasing cost", Operations
// Research 16 (1968) 682-687, divides what is left of a set after its best assignment: some row
// chooses something else, and the rows before it in some order keep what they have.  Miller, Stone
// & Cox, "Optimizing Murty's ranked assignment method", IEEE Transactions on Aerospace and
// Electronic Systems 33 (1997) 851-862: a subset inherits the duals, so that its best assignment is
// one shortest path away; it is not even looked for before a lower bound on its cost has its turn;
// and rows that lose most come first in the order, so that promising subsets are small.
//
// Here a node keeps the graph of what may still change in its subset (exchange_graph.hpp), as
// reduced costs alone; a subset's best assignment is a shortest cycle through the row that chooses
// again. Differences:
//
// Reach.  All that costs more than `reach_` beyond the best is left out of the graphs: pairs, rows,
// cycles.  When the list within reach is at its end, another tree is begun with a larger reach;
// what the former one listed is recognised by its cost, and by comparison where rounding leaves
// doubt. Lists grow so fast with the reach that going through a tree again costs less than keeping
// one that could grow.
//
// Tuning.  Balanced duals and the removal of what is in no cycle (exchange_draft.cpp) make the
// graphs small and the bounds sharp, so that few searches are in vain.
//
// Order.  Rows that are in no cycle without a row follow it and have no subset of their own.  The
// row that chose again comes first, so that its forbidden choices, which its graph simply lacks,
// are all that is ever forbidden.

namespace nda::lap {
namespace {

constexpr int kRounds = 4;         // of tuning; more find little to do
constexpr int kFirstRounds = 10;   // once for each tree
constexpr double kFirstReach = 4;  // times the loss of the second best
constexpr double kGrowth = 1.5;    // of the reach
constexpr double kFastGrowth = 3;  // where hardly anything was in reach
constexpr std::size_t kFewNodes = 16;
constexpr double kNoise = 1e-11;  // of the largest cost

}  // namespace

// Among equals first what is solved, then small subsets.
bool Ranking::is_later(const Entry& a, const Entry& b) {
  if (a.loss != b.loss) return a.loss > b.loss;
  if (a.is_solved != b.is_solved) return b.is_solved;
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
  pool_.start(problem, best);
  assignment_.start(problem, pool_.best());
  is_fresh_ = true;
  reach_ = -1;
  queue_.clear();
}

bool Ranking::next(Assign2dResult& result) {
  if (is_fresh_) {
    is_fresh_ = false;
    assignment_.write(result);
    return true;
  }
  if (reach_ < 0) prepare();
  while (true) {
    while (queue_.empty()) {
      stop_.spend(problem_.cost.size());
      if (!extend()) return false;
    }
    stop_.spend(graph_of(queue_.front().node).num_exchanges());
    const Entry entry = take_first();
    if (!entry.is_solved) {
      solve(entry);
      continue;
    }
    const std::uint32_t node = add_node(entry);
    if (was_listed(node)) continue;
    move_to(node);
    assignment_.write(result);
    if (entry.loss > reach_ - noise_) at_reach_.push_back(result);
    return true;
  }
}

// Whether a former tree listed it.
bool Ranking::was_listed(std::uint32_t node) {
  const double loss = nodes_[node].loss;
  if (loss < listed_reach_ - noise_) return true;
  if (loss > listed_reach_ + noise_) return false;
  move_to(node);
  return std::any_of(at_listed_.begin(), at_listed_.end(), [&](const Assign2dResult& listed) {
    return assignment_.is_in(listed);
  });
}

void Ranking::prepare() {
  const std::uint32_t num_rows = problem_.num_rows();
  search_.resize(num_rows);
  draft_.resize(num_rows);
  noise_ = kNoise * std::max({largest_magnitude(problem_.cost),
                              largest_magnitude(problem_.row_outside),
                              largest_magnitude(problem_.column_outside)});
  at_reach_.clear();
  at_listed_.clear();
  at_ = 0;
  listed_reach_ = -1;
  reach_ = kFirstReach * second_loss() + 4 * noise_;
  begin_tree();
}

// That of the second best assignment; 0 if there is none.
double Ranking::second_loss() {
  reach_ = std::max(pool_.reach_of_few(), 4 * noise_);
  begin_tree();
  double least = kInfinity;
  while (!queue_.empty()) {
    const Entry entry = take_first();
    if (!(entry.loss < least)) break;
    const CycleSearch::Outcome outcome = search_.search(graph_of(0), entry.branch, least);
    if (outcome.found) least = outcome.loss;
  }
  return least < kInfinity ? least : 0;
}

void Ranking::begin_tree() {
  pool_.fill(reach_);
  store_.clear();
  changes_.clear();
  queue_.clear();
  draft_.draw_best(problem_, pool_, reach_);
  draft_.tune(kFirstRounds, reach_);
  draft_.store(false, store_);
  beyond_ = draft_.beyond();
  nodes_.assign(1, {0, 0, 0, 0, 0, static_cast<std::uint32_t>(store_.members.size())});
  judge_branches(0);
}

// Begins another tree that reaches further; false if there is nothing more.
bool Ranking::extend() {
  if (beyond_ == kInfinity) return false;
  const double growth = nodes_.size() < kFewNodes ? kFastGrowth : kGrowth;
  move_to(0);
  listed_reach_ = reach_;
  at_listed_.swap(at_reach_);
  at_reach_.clear();
  reach_ = std::max(beyond_, growth * reach_) + 4 * noise_;
  begin_tree();
  return true;
}

ExchangeGraph Ranking::graph_of(std::uint32_t node) const {
  return store_.graph(nodes_[node].members_begin, nodes_[node].members_end);
}

// The last branch has only its own member, the first has all: whoever comes later bounds it.
void Ranking::judge_branches(std::uint32_t node) {
  const ExchangeGraph graph = graph_of(node);
  entering_.resize(graph.outside() + 1);
  for (std::uint32_t n = 0; n < graph.outside(); ++n) entering_[n] = graph.members[n].drop;
  for (std::uint32_t n = graph.outside(); n-- > 0;) {
    double leaving = kInfinity;
    for (const Exchange& exchange : graph.of(n)) {
      entering_[exchange.target] = std::min(entering_[exchange.target], exchange.loss);
      if (exchange.target > n) leaving = std::min(leaving, exchange.loss);
    }
    if (!graph.members[n].is_branch) continue;
    const double loss = nodes_[node].loss + leaving + entering_[n];
    if (loss <= reach_ && loss < kInfinity) {
      wait({loss, node, n, false});
    } else {
      beyond_ = std::min(beyond_, loss);
    }
  }
}

void Ranking::solve(Entry entry) {
  const double before = nodes_[entry.node].loss;
  const CycleSearch::Outcome outcome =
      search_.search(graph_of(entry.node), entry.branch, reach_ - before);
  entry.loss = before + outcome.loss;
  entry.is_solved = true;
  if (outcome.found) {
    wait(entry);
  } else {
    beyond_ = std::min(beyond_, entry.loss);
  }
}

// Finds the cycle of a solved branch again, which takes less time than it would take memory to
// keep it, and divides what is left of the branch.
std::uint32_t Ranking::add_node(const Entry& entry) {
  const ExchangeGraph graph = graph_of(entry.node);
  search_.search(graph, entry.branch, reach_ - nodes_[entry.node].loss);
  const double spare = reach_ - entry.loss;
  draft_.draw_next(graph, entry.branch, search_, pool_, spare);
  Node node{entry.loss, entry.node, static_cast<std::uint32_t>(changes_.size()), 0, 0, 0};
  list_changes(graph, entry.branch);
  node.changes_end = static_cast<std::uint32_t>(changes_.size());
  draft_.tune(kRounds, spare);
  beyond_ = std::min(beyond_, entry.loss + draft_.beyond());
  node.members_begin = static_cast<std::uint32_t>(store_.members.size());
  draft_.store(true, store_);
  node.members_end = static_cast<std::uint32_t>(store_.members.size());
  nodes_.push_back(node);
  const std::uint32_t added = static_cast<std::uint32_t>(nodes_.size() - 1);
  judge_branches(added);
  return added;
}

void Ranking::list_changes(const ExchangeGraph& graph, std::uint32_t branch) {
  for (std::uint32_t n = branch; n < graph.outside(); ++n) {
    const std::uint32_t row = graph.members[n].row;
    const std::uint32_t pair = draft_.members()[n - branch].held;
    if (pair == graph.members[n].held) continue;
    if (pair == kNone) {
      changes_.push_back({row, kNone, problem_.row_outside[row]});
    } else {
      changes_.push_back({row, pool_.column(pair), pool_.cost(pair)});
    }
  }
}

void Ranking::exchange(std::uint32_t node) {
  const Node& moved = nodes_[node];
  assignment_.exchange(
      std::span(changes_).subspan(moved.changes_begin, moved.changes_end - moved.changes_begin));
}

void Ranking::move_to(std::uint32_t node) {
  way_.clear();
  for (std::uint32_t goal = node; at_ != goal;) {
    if (at_ > goal) {
      exchange(at_);
      at_ = nodes_[at_].parent;
    } else {
      way_.push_back(goal);
      goal = nodes_[goal].parent;
    }
  }
  for (; !way_.empty(); way_.pop_back()) exchange(way_.back());
  at_ = node;
}

}  // namespace nda::lap
