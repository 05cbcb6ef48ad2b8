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

/// Which choices are wanted.
struct Wanted {
  std::size_t count = 1;        ///< the best so many
  double below = kInfinity;     ///< that cost less
  bool only_solutions = false;  ///< those that pay no penalty
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
  /// The wanted that were found, cheapest first, all different: all there are where complete.
  std::vector<Choice> choices;
  /// Valid whatever the end for `best`, and for every choice that is wanted and not among
  /// `choices`; no less than the last of them, or `below`, less the margin, where complete.
  double lower = -kInfinity;
  std::vector<double> u;            ///< the best multipliers before branching, by slot
  double certificate = -kInfinity;  ///< what they prove
  std::int64_t nodes = 0;
  std::size_t live_arcs = 0;  ///< after fixing by the reduced costs of the first linear program
  std::size_t left_arcs = 0;  ///< after all fixing; both all arcs where there was none
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

/// The best choices of a component, by the same search: a branch goes on below a choice that was
/// found until it can hold no other.
///
/// @param starts  choices to begin with; those that are wanted are answers
SearchResult list_best(const BoundedComponent& component,
                       std::span<const Choice> starts,
                       std::span<const double> u,
                       const Wanted& wanted,
                       const SearchLimits& limits);

}  // namespace nda::bounded
