#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "core/clock.hpp"

namespace nda::bounded {

/// What a search may use up and when it is good enough.
struct SearchLimits {
  double margin = 0;       ///< a choice that is better at all is better by more than this
  double allowed_gap = 0;  ///< absolute, that may stay open
  std::int64_t max_nodes = 0;
  core::Deadline deadline;
};

/// Why a search ended.
enum class SearchEnd { kComplete, kGap, kNodes, kDeadline };

/// What a search tells as it goes on.
struct SearchNews {
  std::function<void(const Choice&)> found;  ///< a better choice
  std::function<void(double)> bounded;       ///< a higher bound on all choices
};

/// The answer.
struct SearchResult {
  SearchEnd end = SearchEnd::kComplete;
  Choice best;
  double lower = -kInfinity;  ///< valid whatever the end; >= best.cost - margin where complete
  std::vector<double> u;      ///< the best multipliers before branching, by slot
  double certificate = -kInfinity;  ///< what they prove
  std::int64_t nodes = 0;
  std::size_t live_arcs = 0;  ///< after fixing by reduced costs
};

/// The best choice of a component by linear programs and branching on arcs.
///
/// Column generation solves the linear relaxation, reduced costs fix arcs, and the rest is
/// searched: the node of the lowest bound first, and from there down along the branch that the
/// relaxation prefers until that ends.  No bound is taken from the linear program:
/// lagrangian_bound() computes it from the duals, rounding taken off, so numerical trouble costs
/// time and nothing else.
///
/// @param start  a choice to improve on
/// @param u      multipliers to begin with, by slot
SearchResult branch_and_bound(const BoundedComponent& component,
                              const Choice& start,
                              std::span<const double> u,
                              const SearchLimits& limits,
                              const SearchNews& news);

}  // namespace nda::bounded
