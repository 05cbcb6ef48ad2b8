#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda {

/// Lists the assignments of a two-dimensional problem, best first.
///
///     Assign2dRanking ranking(problem);
///     for (Assign2dResult result; ranking.next(result);) use(result);
///
/// Two assignments differ if their sets of pairs do; what is unassigned follows.  Each comes once,
/// equal costs in any order, always the same one.  An object is used by one thread at a time.
///
/// Source: Murty (1968) with the inherited duals, lazy subproblems and order of the partition of
/// Miller, Stone & Cox (1997), on what is within reach only; docs/assign2d.md.
class Assign2dRanking {
 public:
  /// Copies the problem and checks nothing, as Assign2dSolver does (see validate()).  Solves
  /// nothing yet.
  explicit Assign2dRanking(const Assign2dProblem& problem);
  ~Assign2dRanking();
  Assign2dRanking(Assign2dRanking&& other) noexcept;
  Assign2dRanking& operator=(Assign2dRanking&& other) noexcept;

  /// The next best assignment; false, and `result` left alone, if there is none (an infeasible
  /// problem has none at all).
  ///
  /// Its cost is that of its pairs and outside options, summed afresh; costs never decrease by more
  /// than the rounding of such sums.  The duals are always those of the best assignment: they prove
  /// the first, and what another one costs more is the sum of the reduced costs of its pairs and
  /// outside options.
  ///
  /// Cost: the first is one solve; each later one a few searches for a shortest cycle through what
  /// can still change within reach, and O(rows + columns) to write it down.  Memory grows with each
  /// by what can change, not by the problem.
  bool next(Assign2dResult& result);

  /// From now on next() asks `stop` (null: nobody) every 50000 pairs or so that it looks at, and
  /// throws Assign2dInterrupted when that answers true.  `result` is then left alone, nothing is
  /// lost, and another call goes on: only the first solve begins anew.  Not asked within one search
  /// for a cycle, nor while a tree of subsets is begun: each takes less than a solve.
  void set_stop(const std::function<bool()>* stop);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// The k best assignments, as Assign2dRanking lists them; fewer only if there are no more.
/// Throws InputError where validate() does.
std::vector<Assign2dResult> assign2d_k_best(const Assign2dProblem& problem, std::size_t k);

/// The k best assignments of a dense problem, read as assign2d() reads it: every member of the
/// smaller side is assigned, surplus members of the larger side are free of charge.
///
/// @param cost_row_major  num_rows * num_columns costs; +inf forbids a pair.
/// Throws InputError for another size, and for costs NaN or -inf.
std::vector<Assign2dResult> assign2d_k_best(std::span<const double> cost_row_major,
                                            std::uint32_t num_rows,
                                            std::uint32_t num_columns,
                                            std::size_t k);

}  // namespace nda
