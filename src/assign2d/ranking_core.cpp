#include "assign2d/ranking_core.hpp"

#include <algorithm>

// An assignment costs what the best one costs plus its slack: the reduced costs of its pairs and of
// the outside options that it uses, none of them negative.  So a pair whose reduced cost exceeds
// `reach` is in no assignment within reach, and of a dense problem a few pairs a row are left.

namespace nda::lap {

void RankingCore::select(const Assign2dProblem& problem,
                         std::span<const double> u,
                         std::span<const double> v,
                         double reach) {
  by_row_.start.assign(1, 0);
  by_row_.partner.clear();
  by_row_.cost.clear();
  next_reach_ = kInfinity;
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      const double reduced = problem.cost[k] - u[i] - v[problem.column[k]];
      if (reduced > reach) {
        next_reach_ = reduced < next_reach_ ? reduced : next_reach_;
      } else {
        by_row_.partner.push_back(problem.column[k]);
        by_row_.cost.push_back(problem.cost[k]);
      }
    }
    by_row_.start.push_back(static_cast<std::uint32_t>(by_row_.partner.size()));
  }
}

void RankingCore::transpose(std::uint32_t num_columns) {
  by_column_.start.assign(num_columns + 1, 0);
  by_column_.partner.resize(by_row_.partner.size());
  by_column_.cost.resize(by_row_.cost.size());
  for (const std::uint32_t j : by_row_.partner) ++by_column_.start[j + 1];
  for (std::uint32_t j = 0; j < num_columns; ++j) {
    by_column_.start[j + 1] += by_column_.start[j];
  }
  for (std::uint32_t i = 0; i + 1 < by_row_.start.size(); ++i) {
    for (std::uint32_t k = by_row_.start[i]; k < by_row_.start[i + 1]; ++k) {
      const std::uint32_t at = by_column_.start[by_row_.partner[k]]++;
      by_column_.partner[at] = i;
      by_column_.cost[at] = by_row_.cost[k];
    }
  }
  for (std::uint32_t j = num_columns; j > 0; --j) by_column_.start[j] = by_column_.start[j - 1];
  by_column_.start[0] = 0;
}

void RankingCore::build(const Assign2dProblem& problem,
                        std::span<const double> u,
                        std::span<const double> v,
                        double reach) {
  select(problem, u, v, reach);
  transpose(problem.num_columns());
}

}  // namespace nda::lap
