#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/component.hpp"
#include "cutting/master.hpp"
#include "cutting/search_context.hpp"

namespace nda::cutting {

class LeafSearch;

/// Called after every round with the current relaxed point; returns the cutoff from now on: only
/// packings cheaper than it are looked for.
using CutRoundObserver = std::function<double(const Master&)>;

inline constexpr std::size_t kAllPatterns = 1000;

struct CutLoopOptions {
  double cutoff = kInfinity;
  int max_rounds = 200;            ///< 0 = no cuts, but the linear program is solved
  std::size_t first_patterns = 0;  ///< of patterns(), beside the cuts over three rows, at first
  std::size_t most_patterns = kAllPatterns;  ///< and when the gain has fallen off
  bool thorough = false;                     ///< look harder for cuts before giving up
  /// A round that closes less than this share of the gap calls for harder patterns or ends the
  /// loop.
  double worthwhile = 0.005;
  bool fix = true;             ///< drop arcs for good; not below a branching
  LeafSearch* leaf = nullptr;  ///< what may end the node; may be null
  /// Where to add the work of separation and of `leaf` (bnb::SlackLimits); may be null.
  double* work = nullptr;
  SearchContext context;
};

/// How the loop ended.
enum class CutLoopEnd {
  kProven,    ///< no packing is cheaper than the cutoff, by the bound
  kSearched,  ///< the same, by enumeration
  kIntegral,  ///< the relaxed point is a packing: the best one of the live arcs
  kStalled,   ///< further cuts gain little
  kRounds,    ///< that was the last round
  kStopped,   ///< deadline, or numerical trouble
};

/// Tightens the linear relaxation by cuts as long as that is worth its time: solve, fix by reduced
/// cost, separate, add.  The easy cuts come first; harder patterns join when the gain of a round
/// falls off.
CutLoopEnd run_cut_loop(const core::Component& component,
                        Master& master,
                        const CutLoopOptions& options,
                        const CutRoundObserver& observer);

}  // namespace nda::cutting
