#include "assign2d/full_matrix.hpp"

namespace nda::lap {

DenseProblem FullMatrix::of(const Assign2dProblem& problem) {
  const std::size_t width = problem.num_columns();
  const std::size_t size = problem.num_rows() * width;
  if (problem.cost.size() == size) {
    return {problem.cost, problem.row_outside, problem.column_outside};
  }
  cost_.assign(size, kInfinity);
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      cost_[i * width + problem.column[k]] = problem.cost[k];
    }
  }
  return {cost_, problem.row_outside, problem.column_outside};
}

}  // namespace nda::lap
