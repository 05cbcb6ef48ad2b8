#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/component.hpp"
#include "cutting/leaf_search.hpp"
#include "cutting/master.hpp"
#include "cutting/search_context.hpp"
#include "cutting/tree_search.hpp"

namespace nda::cutting {

struct WideningLimits {
  double cutoff = kInfinity;  ///< only packings cheaper than this are looked for
  double margin = 0;          ///< BranchAndCutLimits::margin
  std::int64_t max_nodes = 0;
  std::vector<Cut> cuts;  ///< to begin with
  /// What the relaxation proves without them; -inf: there are none.
  double lower_without_cuts = -kInfinity;
  /// The proof shows all of the bound if no limit struck, else what the cuts of the whole component
  /// prove, without the circles.
  SearchContext context;
};

/// What may go into better packings.
struct PrimalBudget {
  double work = 0;       ///< (bnb::SlackLimits) a share of that for the bound since the last call
  double total = 0;      ///< for the bound in all
  bool fruitful = true;  ///< one of the last calls found a better one
};

/// What the search tells the layers above while it works.
struct WideningObserver {
  /// A packing (arcs of the component), or null and a relaxed point to make one of.  Returns the
  /// cutoff from now on.
  PackingOffer offer;
  /// The first linear program, with the cuts to begin with alone.
  std::function<void(const Master& point)> relaxed;
  /// A chance to look for better packings: when the first rounds of cuts and searches by their
  /// multipliers did not end it, when more rounds did not, after every circle, and within those
  /// that take long.  Returns the cutoff from now on.
  std::function<double(Master& point, const PrimalBudget& budget)> improve;
  /// No packing is cheaper than `lower`.
  std::function<void(double lower)> raise;
};

struct WideningResult {
  double lower = -kInfinity;  ///< no packing is cheaper than this, or than the last cutoff
  bool complete = false;      ///< no packing is cheaper than the last cutoff
  std::int64_t nodes = 0;
  std::size_t live_arcs = 0;  ///< that reduced costs left when the cuts of the whole were done
  FixingYield fixing;         ///< in circles, and of searches
};

/// Exact search of a component by linear programming, cuts and branching.
///
/// After the cuts the reduced costs say how far an arc is from the relaxed optimum: a packing that
/// uses an arc of reduced cost r costs at least lower + r.  So the search goes out in circles: all
/// packings cheaper than lower + reach, with the few arcs that allows, by branch and cut; when
/// there is none, lower + reach is a proven bound, and the circle is widened.  It needs no good
/// solution to begin with: the first circle that holds one holds the best one.
///
/// @param u  multipliers by slot to start from.
WideningResult search_widening(const core::Component& component,
                               std::span<const double> u,
                               const WideningLimits& limits,
                               const WideningObserver& observer);

}  // namespace nda::cutting
