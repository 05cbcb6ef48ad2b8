#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/component.hpp"
#include "core/pause.hpp"
#include "cutting/cut_loop.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/master.hpp"
#include "cutting/pair_branching.hpp"
#include "cutting/search_context.hpp"

namespace nda::cutting {

/// How long to do without searches that ended no nodes lately.
struct LeafPauses {
  static constexpr int kLongest = 31;  // nodes in a row

  core::Pause slack{kLongest};
  core::Pause cliques{kLongest};
};

/// A node of the tree that somebody else is to explore.
struct OpenNode {
  std::vector<PairBranching::Step> path;  ///< from the root
  double lower = -kInfinity;              ///< what its parent proves for it
  LeafPauses pauses;
  std::size_t proof_size = 0;  ///< the proof had so many steps: its own go there
};

struct BranchAndCutLimits {
  std::int64_t max_nodes = 0;
  int root_rounds = 200;  ///< of cuts (CutLoopOptions::max_rounds)
  std::size_t root_patterns = 0;
  std::size_t node_patterns = 4;  ///< of cuts; those over three indices are always looked for
  int node_rounds = 3;
  bool thorough = true;                      ///< CutLoopOptions::thorough at the root
  double leaf_work = LeafLimits{}.max_work;  ///< LeafLimits::max_work of a node
  /// Packings are to be cheaper than the best by so much: what a cutoff stands below it.
  double margin = 0;
  SearchContext context;  ///< the proof shows the whole tree if the search is exhaustive
  /// Where more packings count than the best: all below the cutoff are offered, and others.  Null =
  /// that alone; else without a proof.
  const LeafRanks* ranks = nullptr;
  /// Called before every branching with the nodes and the work so far, a chance to look for better
  /// packings elsewhere; returns the cutoff from now on.  May be empty.
  std::function<double(std::int64_t nodes, double work)> pause;
};

/// What came out of branch and cut.
struct BranchAndCutResult {
  double lower = -kInfinity;    ///< no packing of live arcs is cheaper than this and the cutoff,
                                ///< but for those of open nodes
  bool complete = false;        ///< no packing is cheaper than the last cutoff
  bool exhaustive = true;       ///< no node was left unexplored
  std::int64_t nodes = 0;       ///< those of searches included
  std::int64_t tree_nodes = 0;  ///< without them
  double work = 0;              ///< (bnb::SlackLimits)
  FixingYield fixing;           ///< at the root, and of searches
  std::vector<OpenNode> open;   ///< those handed over, in order of the tree
};

/// Branch and cut over the live arcs of `master`: bounds by its linear relaxation, tightened by
/// cuts at every node, branching on pairs of rows (cutting/pair_branching.hpp).
///
/// Depth first, the child with the smaller bound first.  The bound holds whenever it stops.
class BranchAndCut {
 public:
  BranchAndCut(const core::Component& component,
               Master& master,
               double cutoff,
               const BranchAndCutLimits& limits,
               PackingOffer offer);

  /// Below a node, by default the root.  `master` is then where so many steps of the node's path
  /// lead, and in the end where all of them do.
  /// @param handover_work  from this work on (bnb::SlackLimits) nodes are left open.
  BranchAndCutResult run(const OpenNode& node = {},
                         std::size_t steps = 0,
                         double handover_work = kInfinity);

  /// How much of the tree below the root is done, if subtrees of one depth are of one size: 0 .. 1.
  double progress() const { return progress_; }

 private:
  double explore(int depth, double inherited);
  CutLoopEnd tighten(int depth);
  LeafLimits leaf_limits() const;
  double close(int depth, double lower);
  double close_single(int depth, double lower);
  double finish(int depth, double lower);
  bool integral() const;
  core::Packing packing() const;
  bool stopped() const {
    return num_nodes() >= limits_.max_nodes || limits_.context.deadline.reached();
  }
  double work() const;
  std::int64_t num_nodes() const { return tree_nodes_ + search_nodes_; }
  double leave(double lower);

  const core::Component& component_;
  Master& master_;
  double cutoff_;
  const BranchAndCutLimits& limits_;
  PackingOffer offer_;
  PairBranching branching_;
  std::vector<PairBranching::Step> path_;  // to the node that is being explored
  std::vector<OpenNode> open_;
  double handover_work_ = kInfinity;
  const std::int64_t first_pivots_;
  std::int64_t tree_nodes_ = 0;
  std::int64_t search_nodes_ = 0;
  double search_work_ = 0;  // of separation, too
  FixingYield fixing_;
  LeafPauses pauses_;
  double progress_ = 0;
  bool exhaustive_ = true;
};

}  // namespace nda::cutting
