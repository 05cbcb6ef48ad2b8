#pragma once

#include "assign2d/sparse_solver.hpp"

namespace nda::lap {

/// LEMON's network simplex: slow, and as unlike the other methods as can be;
/// alone in knowing bounds.
class NetworkSimplexSolver final : public Assign2dSolver {
 public:
  void set_stop(const std::function<bool()>* stop) override { finisher_.set_stop(stop); }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override;
  static void solve_bounded(const Assign2dProblem& problem, Assign2dResult& result);

  SparseSolver finisher_;
};

}  // namespace nda::lap
