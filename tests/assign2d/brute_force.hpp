#pragma once

#include <algorithm>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::support {

/// The optimum by dynamic programming over sets of used columns; +inf if infeasible.
/// O(2^columns * pairs): for at most about ten columns.
inline double brute_force_cost(const Assign2dProblem& problem) {
  const std::size_t num_sets = std::size_t{1} << problem.num_columns();
  std::vector<double> best(num_sets, kInfinity);
  best[0] = 0;
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    std::vector<double> next(num_sets, kInfinity);
    for (std::size_t used = 0; used < num_sets; ++used) {
      if (best[used] == kInfinity) continue;
      next[used] = std::min(next[used], best[used] + problem.row_outside[i]);
      for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
        const std::size_t bit = std::size_t{1} << problem.column[k];
        if ((used & bit) != 0) continue;
        next[used | bit] = std::min(next[used | bit], best[used] + problem.cost[k]);
      }
    }
    best = std::move(next);
  }
  double optimum = kInfinity;
  for (std::size_t used = 0; used < num_sets; ++used) {
    double cost = best[used];
    for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
      if ((used >> j & 1) == 0) cost += problem.column_outside[j];
    }
    optimum = std::min(optimum, cost);
  }
  return optimum;
}

}  // namespace nda::support
