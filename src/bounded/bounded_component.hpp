#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::bounded {

/// How often an index is to be used, and what it costs to use it too seldom.  Of n arcs it asks
///
///     f(n) = single * max(0, lo - n)   for n <= hi,   +inf beyond,
///
/// a convex function.  (An index whose singleton pays has lo = hi: it is left alone as often as it
/// may be.)
struct Row {
  double single = 0;  ///< >= 0 where lo < hi; finite: of a forbidden singleton it is a penalty
  Index lo = 0;
  Index hi = 0;            ///< <= number of arcs, >= lo
  bool is_open = false;    ///< there are no more than hi arcs
  bool is_forced = false;  ///< its singleton is forbidden, `single` the penalty

  double cost(Index uses) const { return uses < lo ? single * (lo - uses) : 0.0; }
  /// min over 0 <= n <= hi of f(n) + u n: at a corner of f.
  double value(double u) const { return std::min({single * lo, u * lo, u * hi}); }
  /// The number nearest to `uses` that attains value(u).
  Index best_uses(double u, Index uses) const;
  /// The nearest multiplier that proves no less: no more than a use can save, and not negative
  /// where there is nothing to be held back from.
  double clamped(double u) const {
    const double most = std::min(u, lo > 0 ? single : 0.0);
    return is_open ? std::max(std::min(0.0, single), most) : most;
  }
};

/// A connected component of a problem with bounds:
///
///     minimise   sum of c'[a] over chosen arcs  +  sum over indices of f_i(number of chosen arcs
///     on i).
///
/// `graph` has the arcs and what they cost; its slots have no other meaning than that of `rows`.
struct BoundedComponent {
  core::Component graph;
  std::vector<Row> rows;  ///< [slot]; nothing of the dummies

  std::size_t num_arcs() const { return graph.num_arcs(); }
};

/// What is chosen of a component, arcs ascending, and what that costs.
struct Choice {
  std::vector<core::ArcId> arcs;
  double cost = 0;
};

/// The choice of these arcs, which exceed no bound; its cost summed in double-double.
Choice make_choice(const BoundedComponent& component, std::vector<core::ArcId> arcs);

/// How many of these arcs use each slot; those of dummies count for nothing.
std::vector<Index> count_uses(const core::Component& graph, std::span<const core::ArcId> arcs);

/// How many uses a choice lacks of indices with forbidden singletons; 0: it is a solution.
std::size_t missing_uses(const BoundedComponent& component, std::span<const core::ArcId> arcs);

/// Sum over all indices of the largest number of uses: no choice has more terms.
double most_uses(const BoundedComponent& component);

}  // namespace nda::bounded
