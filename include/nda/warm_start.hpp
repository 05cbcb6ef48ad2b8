#pragma once

#include <vector>

#include "nda/solution.hpp"
#include "nda/types.hpp"

namespace nda {

/// What is known of a problem before it is solved, usually the solution of the last window of a
/// tracker.
///
///     nda::WarmStart last;
///     for (;;) {
///       const nda::Problem window = ...;                    // one scan further
///       const nda::Solution solution = nda::solve(window, options, last);
///       last = nda::warm_start(solution);
///       last.shift(1);
///     }
///
/// Advice, never trusted: answers are proven as they are without it, and cost the same.  Whatever
/// does not fit the problem is ignored: indices it does not have, arcs that overlap, multipliers
/// that are not finite.  Plain data, to be changed at will.
struct WarmStart {
  /// u[k][i-1] as in Solution; dimensions and indices may be missing, as in a window that gained
  /// some.
  std::vector<std::vector<double>> multipliers;

  /// Tuples of indices, 0 = dummy.  They need not be arcs: the indices of a tuple belong together,
  /// and arcs are looked for that continue it, so one tuple says which track has which detections.
  std::vector<std::vector<Index>> arcs;

  bool empty() const { return multipliers.empty() && arcs.empty(); }

  /// For a window that drops `dimensions` of them, the first ones after `kept`, and gains as many
  /// at its end, of which nothing is known.  `kept` = 1 where dimension 0 is the list of tracks.
  /// Nothing stays that is in dropped dimensions only.  Throws InputError where either is negative.
  void shift(int dimensions, int kept = 0);
};

/// The multipliers and the arcs of the best solution; empty where there are none.
WarmStart warm_start(const Solution& solution);

}  // namespace nda
