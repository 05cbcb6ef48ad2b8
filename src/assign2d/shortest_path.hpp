#pragma once

#include <span>

#include "assign2d/core_solver.hpp"
#include "assign2d/dense_solver.hpp"
#include "assign2d/full_matrix.hpp"
#include "assign2d/sparse_solver.hpp"

namespace nda::lap {

/// Shortest augmenting paths on the stored pairs, on the full matrix, or on a core of it: whichever
/// measured fastest (docs/assign2d.md).
class ShortestPathSolver final : public Assign2dSolver {
 public:
  void solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm = false) {
    if (problem.cost.size() < kCoreSize) {
      dense_.solve_matrix(problem, result, warm);
    } else {
      core_.solve_matrix(problem, result, warm);
    }
  }
  void set_stop(const std::function<bool()>* stop) override {
    sparse_.set_stop(stop);
    dense_.set_stop(stop);
    core_.set_stop(stop);
  }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override {
    const double full = static_cast<double>(problem.num_rows()) * problem.num_columns();
    if (static_cast<double>(problem.cost.size()) >= kDenseShare * full) {
      solve_matrix(matrix_.of(problem), result, warm);
    } else if (warm) {
      sparse_.solve_warm(problem, result);
    } else {
      sparse_.solve(problem, result);
    }
  }

  static constexpr double kDenseShare = 0.5;
  static constexpr std::size_t kCoreSize = 20000;

  SparseSolver sparse_;
  DenseSolver dense_;
  CoreSolver core_;
  FullMatrix matrix_;
};

}  // namespace nda::lap
