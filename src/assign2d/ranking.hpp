#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "assign2d/ranking_core.hpp"
#include "assign2d/ranking_search.hpp"
#include "assign2d/ranking_state.hpp"
#include "assign2d/ranking_subproblem.hpp"
#include "nda/assign2d.hpp"

namespace nda::lap {

/// Murty's tree of subsets, which lists assignments best first: what Assign2dRanking is made of.
class Ranking {
 public:
  /// Begins with the assignment `best`, which must be feasible, with duals that prove it.
  /// @param problem  must outlive the ranking.
  void start(const Assign2dProblem& problem, const Assign2dResult& best);

  /// The one after the last; false, and `result` left alone, if there is none.
  bool next(Assign2dResult& result);

 private:
  // A subset with its best assignment.  Once that has had its turn, the rest of the subset is
  // divided into branches, one for each row that has something else to choose within reach.
  struct Node {
    std::uint32_t parent;     // of the root: itself
    std::uint32_t branch;     // of the parent, of which this is the best assignment
    std::uint32_t row;        // of that branch; of the root: kNone
    std::uint32_t forbidden;  // first of the choices that this row made before; kNone = no more
    double loss;              // what the assignment costs more than the best one of all
    ChangeRange changes;      // against the parent
    ChangeRange tuning;       // of its duals, thereafter
    std::uint32_t branches_begin;
    std::uint32_t branches_end;
  };

  struct Forbidden {
    std::uint32_t choice;  // a column, or kNone: the outside option
    std::uint32_t next;
  };

  // What waits: a branch of a node to be solved, or (branch = kNone) a node whose turn it is next.
  struct Entry {
    double loss;  // of a branch: at least so much
    std::uint32_t node;
    std::uint32_t branch;
  };

  struct RowLoss {
    double loss;
    std::uint32_t row;
  };

  static bool is_later(const Entry& a, const Entry& b);
  void wait(const Entry& entry);
  Entry take_first();

  void begin_tree();
  void prepare();
  double second_loss();
  bool extend();
  bool was_listed();
  void move_to(std::uint32_t node);
  void divide(std::uint32_t node);
  void open_rows(const Node& node);
  void tune(double spare, bool is_logged);
  void append_branches(const Node& node);
  void judge_branches(std::uint32_t node);
  void solve_branch(std::uint32_t node, std::uint32_t branch);
  void forbid(std::uint32_t row, std::uint32_t first);

  Assign2dProblem problem_;
  std::vector<double> best_u_;
  std::vector<double> best_v_;
  double noise_ = 0;  // losses cannot be told apart better than this

  double reach_ = -1;                      // losses up to this are in the core
  double listed_reach_ = -1;               // those up to this have been listed, by former trees
  double beyond_ = 0;                      // least loss known of what is out of reach
  std::vector<Assign2dResult> at_reach_;   // listed ones within noise of reach_
  std::vector<Assign2dResult> at_listed_;  // of listed_reach_

  RankingCore core_;
  RankingState state_;
  RankingSubproblem subproblem_;
  RankingSearch search_;

  std::uint32_t at_ = 0;             // node that the state is at
  std::uint32_t undivided_ = kNone;  // node that had its turn last
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> branches_;  // the row of each
  std::vector<Forbidden> forbidden_;
  std::vector<Entry> queue_;        // a heap
  std::vector<std::uint32_t> way_;  // to the node moved to
  std::vector<RowLoss> open_;       // rows of a node, while it is being divided
};

}  // namespace nda::lap
