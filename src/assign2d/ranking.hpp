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
  // A subset with its best assignment.  Once that has been listed, the rest of the subset is
  // divided into branches, one for each row that may still choose.
  struct Node {
    std::uint32_t parent;     // of the root: itself
    std::uint32_t branch;     // of the parent, of which this is the best assignment
    std::uint32_t row;        // of that branch; of the root: kNone
    std::uint32_t forbidden;  // first of the choices that this row made before; kNone = no more
    double loss;              // what the assignment costs more than the best one of all
    ChangeRange changes;      // against the parent
    std::uint32_t branches_begin;
    std::uint32_t branches_end;
  };

  // The assignments of a node in which this row chooses something else, and the rows of the
  // branches before it keep what they have.
  struct Branch {
    std::uint32_t row;
    bool is_listed;  // the best of them
  };

  struct Forbidden {
    std::uint32_t choice;  // a column, or kNone: the outside option
    std::uint32_t next;
  };

  // What waits: a branch of a node to be solved, or (branch = kNone) a node to be listed.
  struct Entry {
    double loss;  // of a branch: at least so much
    std::uint32_t node;
    std::uint32_t branch;
  };

  static bool is_later(const Entry& a, const Entry& b);
  void wait(const Entry& entry);
  Entry take_first();

  void measure_rows();
  void set_reach(double reach);
  bool extend();
  void list(std::uint32_t node, Assign2dResult& result);
  void move_to(std::uint32_t node);
  void divide(std::uint32_t node);
  void append_open_rows(const Node& node);
  std::uint32_t sort_branches(const Node& node, std::uint32_t begin);
  void judge_branch(std::uint32_t node, std::uint32_t branch);
  void judge_branches(std::uint32_t node, std::uint32_t begin);
  void solve_branch(std::uint32_t node, std::uint32_t branch);
  void forbid(std::uint32_t row, std::uint32_t first);

  Assign2dProblem problem_;
  std::vector<double> best_u_;
  std::vector<double> best_v_;
  std::vector<double> row_losses_;  // finite least losses by the rows of the best, ascending
  double noise_ = 0;                // losses cannot be told apart better than this

  double reach_ = 0;  // losses up to this are being looked at
  std::size_t reach_rank_ = 0;
  double beyond_ = 0;  // least loss known of what is out of reach, core pairs only
  RankingCore core_;
  RankingState state_;
  RankingSubproblem subproblem_;
  RankingSearch search_;

  std::uint32_t at_ = 0;             // node that the state is at
  std::uint32_t undivided_ = kNone;  // node listed last
  std::vector<Node> nodes_;
  std::vector<Branch> branches_;
  std::vector<Forbidden> forbidden_;
  std::vector<Entry> queue_;            // a heap
  std::vector<std::uint32_t> divided_;  // nodes whose branches are known
  std::vector<std::uint32_t> way_;      // to the node moved to
  std::vector<Entry> near_;             // rows and their losses, while they are being sorted
};

}  // namespace nda::lap
