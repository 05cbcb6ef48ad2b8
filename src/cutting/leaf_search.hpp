#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bnb/clique_search.hpp"
#include "bnb/slack_search.hpp"
#include "core/component.hpp"
#include "core/pause.hpp"
#include "cutting/master.hpp"
#include "cutting/search_context.hpp"

namespace nda::cutting {

/// Called with every packing found (arcs of the component), or with null and a relaxed point to
/// make one of; returns the cutoff from now on: only packings cheaper than it are looked for.
using PackingOffer = std::function<double(const Master&, const core::Packing* packing)>;

/// Components with more live arcs are not searched.
inline constexpr std::size_t kMostLeafArcs = 200000;

/// Pivots of the simplex method as work of a search (bnb::SlackLimits): what takes as long.
inline double work_of_pivots(std::int64_t pivots, std::size_t num_rows) {
  return static_cast<double>(pivots) * (2000 + 2 * static_cast<double>(num_rows));
}

/// Packings of a slack problem that a search listed.
struct LeafFinds {
  std::vector<std::vector<std::uint32_t>> packings;
  bool complete = false;  ///< these are the best below the budget, as many as count, or all of them
  std::int64_t nodes = 0;
  double work = 0;
  FixingYield fixing;
};

/// Where more packings count than the best.
struct LeafRanks {
  std::size_t k = 1;       ///< so many
  bool may_cover = false;  ///< by cliques
  double least = 0;        ///< no packing is cheaper, not even where it leaves forced slots alone
  /// The k of least slack below a budget.
  std::function<LeafFinds(const bnb::SlackProblem&, double budget, const bnb::SlackLimits&)> list;
};

struct LeafLimits {
  double max_work = 1e6;       ///< of searches (bnb::SlackLimits) for every call; 0 = none
  std::int64_t max_nodes = 0;  ///< of all searches
  SearchContext context;
  const LeafRanks* ranks = nullptr;  ///< null = the best packing alone counts
};

/// Ends a node of branch and cut by enumeration, in one of two ways.  Once its multipliers are good
/// enough, a search within the reduced costs they found (bnb/slack_search.hpp) often ends in
/// milliseconds what LP and cuts would take seconds to close.  It needs no good packing to begin
/// with: the budget is doubled until the best packing is within.  Where multipliers stay bad,
/// covers by cliques (bnb/clique_search.hpp) may do, if arcs are few.  Tries again when a good part
/// of what failed is gone, or when what it may do, which adds up over calls, pivots and separation,
/// has doubled.
class LeafSearch {
 public:
  /// @param pivots        of the master before the node.
  /// @param clique_pause  of the tree's searches by cliques, which seldom end nodes where they did
  ///                      not end others; null = none pauses.
  LeafSearch(const core::Component& component,
             const LeafLimits& limits,
             std::int64_t pivots,
             const PackingOffer& offer,
             core::Pause* clique_pause = nullptr)
      : component_(component),
        limits_(limits),
        offer_(offer),
        pivots_(pivots),
        clique_pause_(clique_pause) {}

  /// Searches the allowed arcs of a solved `master` for packings cheaper than `cutoff`, offers the
  /// best one, or the best LeafRanks::k, and lowers the cutoff accordingly.  Returns whether there
  /// is none below the cutoff any more that was not offered; false also where the search took too
  /// long.
  bool operator()(const Master& master, double& cutoff);

  /// The same by cliques alone, whenever it is called.
  bool cover(const Master& master, double& cutoff);

  /// Other work that was done on the node: the next search may take as long.
  void earn(double work) { credit_ += work; }

  std::int64_t nodes() const { return nodes_; }
  double work() const { return work_; }  ///< of all searches
  /// Of those within the slack.
  const FixingYield& fixing() const { return fixing_; }

 private:
  bool is_worth_trying(const Master& master, double cutoff) const;
  bool search_slack(const Master& master, double& cutoff);
  LeafFinds list(const bnb::SlackProblem& problem, double budget, const bnb::SlackLimits& limits);
  bool search_cliques(const Master& master, double& cutoff);
  bool rank_cliques(const Master& master, double& cutoff);
  bnb::CliqueLimits clique_limits() const;
  void lower(const Master& master, const core::Packing& packing, double& cutoff) const;

  const core::Component& component_;
  const LeafLimits limits_;
  const PackingOffer& offer_;
  std::int64_t pivots_;  // of the master so far
  core::Pause* const clique_pause_;
  double credit_ = 0;  // work that a search may do
  double failed_work_ = kInfinity;
  double failed_gap_ = kInfinity;
  double failed_budget_ = kInfinity;
  double failed_lower_ = kInfinity;
  std::int64_t nodes_ = 0;
  double work_ = 0;
  FixingYield fixing_;
};

}  // namespace nda::cutting
