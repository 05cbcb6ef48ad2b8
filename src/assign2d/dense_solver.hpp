#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/dense_paths.hpp"
#include "assign2d/side.hpp"

namespace nda::lap {

/// A full matrix of costs with outside options; +inf forbids a pair.
struct DenseProblem {
  std::span<const double> cost;  ///< row by row
  std::span<const double> row_outside;
  std::span<const double> column_outside;
};

/// Shortest augmenting paths on a full matrix.
class DenseSolver final : public Assign2dSolver {
 public:
  void solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm);

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override;
  void match_tight_pairs(const DenseProblem& problem, Assign2dResult& result) const;
  bool serve(const DenseProblem& problem, Assign2dResult& result);

  DensePaths paths_;
  std::vector<double> matrix_;   // of a problem that stores fewer pairs
  std::vector<double> columns_;  // the matrix by columns
};

}  // namespace nda::lap
