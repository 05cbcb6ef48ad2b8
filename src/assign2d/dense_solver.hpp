#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/dense_paths.hpp"
#include "assign2d/full_matrix.hpp"
#include "assign2d/side.hpp"

namespace nda::lap {

/// Shortest augmenting paths on a full matrix.
class DenseSolver final : public Assign2dSolver {
 public:
  void solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm);
  void set_stop(const std::function<bool()>* stop) override { paths_.set_stop(stop); }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override {
    solve_matrix(matrix_.of(problem), result, warm);
  }
  void match_tight_pairs(const DenseProblem& problem, Assign2dResult& result) const;
  bool serve(const DenseProblem& problem, Assign2dResult& result);

  DensePaths paths_;
  FullMatrix matrix_;
  std::vector<double> columns_;  // the matrix by columns
};

}  // namespace nda::lap
