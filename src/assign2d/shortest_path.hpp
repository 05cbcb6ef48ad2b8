#pragma once

#include "assign2d/dense_solver.hpp"
#include "assign2d/sparse_solver.hpp"

namespace nda::lap {

/// Shortest augmenting paths, on the stored pairs or on the full matrix, whichever is faster.
class ShortestPathSolver final : public Assign2dSolver {
 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override {
    const double full = static_cast<double>(problem.num_rows()) * problem.num_columns();
    const bool dense = static_cast<double>(problem.cost.size()) >= kDenseShare * full;
    Assign2dSolver& solver = dense ? static_cast<Assign2dSolver&>(dense_) : sparse_;
    if (warm) {
      solver.solve_warm(problem, result);
    } else {
      solver.solve(problem, result);
    }
  }

  static constexpr double kDenseShare = 0.5;  // measured: docs/assign2d.md

  SparseSolver sparse_;
  DenseSolver dense_;
};

}  // namespace nda::lap
