#pragma once

#include <algorithm>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::support {

/// The costs of all assignments, ascending, by trying every choice of every row.
class AllAssignments {
 public:
  explicit AllAssignments(const Assign2dProblem& problem)
      : problem_(problem), is_taken_(problem.num_columns(), false) {
    choose(0, 0);
    std::sort(costs_.begin(), costs_.end());
  }

  const std::vector<double>& costs() const { return costs_; }

 private:
  void choose(std::uint32_t i, double cost) {
    if (cost == kInfinity) return;
    if (i == problem_.num_rows()) {
      for (std::uint32_t j = 0; j < problem_.num_columns(); ++j) {
        if (!is_taken_[j]) cost += problem_.column_outside[j];
      }
      if (cost < kInfinity) costs_.push_back(cost);
      return;
    }
    choose(i + 1, cost + problem_.row_outside[i]);
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const std::uint32_t j = problem_.column[k];
      if (is_taken_[j]) continue;
      is_taken_[j] = true;
      choose(i + 1, cost + problem_.cost[k]);
      is_taken_[j] = false;
    }
  }

  const Assign2dProblem& problem_;
  std::vector<bool> is_taken_;
  std::vector<double> costs_;
};

}  // namespace nda::support
