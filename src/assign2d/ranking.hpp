#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "assign2d/cycle_search.hpp"
#include "assign2d/exchange_draft.hpp"
#include "assign2d/exchange_graph.hpp"
#include "assign2d/listed_assignment.hpp"
#include "assign2d/pair_pool.hpp"
#include "assign2d/stop_check.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// Murty's tree of subsets, which lists assignments best first: what Assign2dRanking is made of.
class Ranking {
 public:
  /// Begins with the assignment `best`, which must be feasible, with duals that prove it.
  /// @param problem  must outlive the ranking.
  void start(const Assign2dProblem& problem, const Assign2dResult& best);

  /// The one after the last; false, and `result` left alone, if there is none.  Where it throws
  /// Assign2dInterrupted, the next call goes on.
  bool next(Assign2dResult& result);
  /// Asked between two searches, and where another tree is begun.
  void set_stop(const std::function<bool()>* stop) { stop_.set(stop); }

 private:
  // A subset with its best assignment.  The rest of the subset is divided into branches, one for
  // each member of its graph: that member chooses again, those before it keep what they have.
  struct Node {
    double loss;  // what the assignment costs more than the best one of all
    std::uint32_t parent;
    std::uint32_t changes_begin;  // against the parent
    std::uint32_t changes_end;
    std::uint32_t members_begin;
    std::uint32_t members_end;
  };

  // A branch that waits for its turn.
  struct Entry {
    double loss;  // of the best assignment in it; until that is known, at least so much
    std::uint32_t node;
    std::uint32_t branch;
    bool is_solved;
  };

  static bool is_later(const Entry& a, const Entry& b);
  void wait(const Entry& entry);
  Entry take_first();

  void prepare();
  double second_loss();
  void begin_tree();
  bool extend();
  ExchangeGraph graph_of(std::uint32_t node) const;
  void judge_branches(std::uint32_t node);
  void solve(Entry entry);
  std::uint32_t add_node(const Entry& entry);
  void list_changes(const ExchangeGraph& graph, std::uint32_t branch);
  void move_to(std::uint32_t node);
  void exchange(std::uint32_t node);
  bool was_listed(std::uint32_t node);

  Assign2dProblem problem_;
  StopCheck stop_;
  double noise_ = 0;  // losses cannot be told apart better than this
  bool is_fresh_ = true;

  double reach_ = 0;                       // losses up to this are in the tree
  double listed_reach_ = 0;                // those up to this were, in former trees
  double beyond_ = 0;                      // all that is out of reach loses at least so much
  std::vector<Assign2dResult> at_reach_;   // listed ones within noise of reach_
  std::vector<Assign2dResult> at_listed_;  // of listed_reach_

  PairPool pool_;
  CycleSearch search_;
  ExchangeDraft draft_;
  ExchangeStore store_;
  ListedAssignment assignment_;
  std::uint32_t at_ = 0;  // node that the assignment is at
  std::vector<Node> nodes_;
  std::vector<RowChange> changes_;
  std::vector<Entry> queue_;  // a heap
  std::vector<std::uint32_t> way_;
  std::vector<double> entering_;
};

}  // namespace nda::lap
