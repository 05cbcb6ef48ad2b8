#pragma once

#include <optional>
#include <vector>

#include "core/component.hpp"
#include "nda/solution.hpp"
#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// A component solved by reductions alone.
struct Settled {
  core::Packing best;
  std::vector<double> u;   ///< by slot, u <= 0
  double certificate = 0;  ///< sum u + sum over arcs of min(0, reduced cost): a bound whatever the
                           ///< rules did
};

/// Which rules are applied.
enum class Effort {
  kQuick,  ///< outweighing arcs, redundant indices, single choices
  kAll,    ///< and dominated arcs, and sides that hang on one index
};

/// Applies the reductions to components; keeps its memory between calls.
class Reducer {
 public:
  /// Applies the rules in turn until none does anything or kMostRounds rounds are over.
  /// Cost O(A N) a round, and what the rules of kAll take.  Deterministic.
  void reduce(const core::Component& component, Effort effort);

  /// The same, but gives up where the component will hardly be settled: with kQuick at once unless
  /// its cheapest arc outweighs all it excludes.  Nothing where arcs are left.
  std::optional<Settled> settle(const core::Component& component, Effort effort);

  /// Of the last component; all 0 where settle() gave it up at once.
  const ReductionYield& yield() const { return yield_; }
  const ArcPool& pool() const { return pool_; }

 private:
  void run_rounds(const core::Component& component, Effort effort, bool patient);
  bool round(Effort effort);
  void apply_quick_rules();
  void apply_thorough_rules();

  ArcPool pool_;
  ReductionYield yield_;
};

}  // namespace nda::reduce
