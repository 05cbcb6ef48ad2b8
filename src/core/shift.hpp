#pragma once

#include <cstdint>
#include <vector>

#include "core/clock.hpp"
#include "core/double_double.hpp"
#include "nda/problem.hpp"

namespace nda::core {

/// The cost shift: every index is charged `base` up front, an arc refunds what its indices were
/// charged.
///
///     c'[a] = c[a] - sum of base over the indices of a,    cost = constant + sum of c' over chosen
///     arcs.
///
/// `base` is the singleton's cost, or `penalty` where the singleton is forbidden.  Whatever the
/// penalty, solutions that cover all these indices keep their cost, so a bound is a bound, and a
/// best solution that covers them is the best.  Where it is high enough, one that leaves such an
/// index uncovered costs more than any that covers them all.
/// Source: report, section 4.8 (invariance); the penalty is ours.
struct Shift {
  std::vector<std::vector<double>> base;  ///< [k][i], entry 0 is 0
  std::vector<std::uint32_t>
      offset;                ///< slot of the dummy of dimension k; slot(k, i) = offset[k] + i
  double constant = 0;       ///< sum of all base: the cost of choosing nothing
  double penalty = 0;        ///< 0 when no singleton is forbidden
  bool is_enough = true;     ///< no best solution pays the penalty where any solution does not
  std::vector<int> charged;  ///< dimensions with a charge that is not 0
};

/// Cost: O(indices).
bool has_forbidden_singleton(const Problem& problem);

/// @param most_penalty  >= 1: the penalty is no higher, even if that is not enough.  High ones hide
///                      the digits of the costs.  Where it is above N + 1 times the largest |c|,
///                      every arc of an index with a forbidden singleton keeps c' < 0.
///
/// Throws InputError where an index has bounds other than 1..1: it may then be used twice at a
/// cost. Where the deadline strikes before the penalty is known it is 0: the shift is then good for
/// bounds, not for searching.
Shift make_shift(const Problem& problem,
                 const Deadline& deadline = {},
                 double most_penalty = kInfinity);

/// c'[a], rounded once: charges may cancel, and then what is left of the cost decides.
inline double shifted_cost(const Problem& problem, const Shift& shift, std::size_t a) {
  DoubleDouble cost(problem.costs()[a]);
  for (const int k : shift.charged)
    cost.add(-shift.base[static_cast<std::size_t>(k)][problem.indices(k)[a]]);
  return cost.high();
}

/// The spacing of the costs: every cost is a multiple of `step` up to one rounding error.
/// step = 10^-d for the smallest d in 0..9 that fits, 0 when none does.  A bound may then be
/// rounded up to the next multiple (design, 3.4).  exact: step is 1, all costs are integers without
/// error.
struct CostGrid {
  double step = 0;
  bool exact = false;
  double largest = 0;  ///< of the finite costs, in size; 0 where there is no grid
};

/// No grid where the deadline strikes.
CostGrid find_grid(const Problem& problem, const Deadline& deadline = {});

}  // namespace nda::core
