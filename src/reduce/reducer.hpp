#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// The rules, and for each how much it did; sums over components.
struct Yield {
  std::size_t dominated = 0;     ///< arcs that others within their indices replace
  std::size_t redundant = 0;     ///< indices that another one speaks for
  std::size_t outweighing = 0;   ///< arcs taken as they outweigh all they exclude
  std::size_t excluded = 0;      ///< arcs that these exclude
  std::size_t single = 0;        ///< arcs put off as the only choice besides those of an index
  std::size_t unprofitable = 0;  ///< arcs that cost no less than these
  std::size_t sides = 0;         ///< parts that hung on one index
  std::size_t side_arcs = 0;     ///< and their arcs
  std::size_t left = 0;          ///< arcs that no rule removed

  Yield& operator+=(const Yield& other);
};

/// A component solved by reductions alone.
struct Settled {
  core::Packing best;
  std::vector<double> u;   ///< by slot, u <= 0
  double certificate = 0;  ///< sum u + sum over arcs of min(0, reduced cost): a bound whatever the
                           ///< rules did
};

/// Applies the reductions to components; keeps its memory between calls.
class Reducer {
 public:
  /// Applies all rules in turn until none does anything or kMostRounds rounds are over, dominance
  /// only while at most `most_dominance` arcs are left.
  /// Cost O(A N) a round, and what dominance takes.  Deterministic.
  void reduce(const core::Component& component, std::size_t most_dominance);

  /// The same, but gives up early where the component will not be settled: after a round that
  /// removed few of many arcs.  Nothing where arcs are left.
  std::optional<Settled> settle(const core::Component& component);

  const Yield& yield() const { return yield_; }
  const ArcPool& pool() const { return pool_; }

 private:
  bool round(std::size_t most_dominance);

  ArcPool pool_;
  Yield yield_;
};

}  // namespace nda::reduce
