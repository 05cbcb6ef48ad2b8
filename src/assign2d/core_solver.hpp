#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assign2d/dense_solver.hpp"
#include "assign2d/full_matrix.hpp"
#include "assign2d/sparse_solver.hpp"

namespace nda::lap {

/// Solves a full matrix by way of a small core of promising pairs.
class CoreSolver final : public Assign2dSolver {
 public:
  void solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm);
  void set_stop(const std::function<bool()>* stop) override {
    sparse_.set_stop(stop);
    dense_.set_stop(stop);
  }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override {
    solve_matrix(matrix_.of(problem), result, warm);
  }
  void reserve(const DenseProblem& problem);
  void choose_core(const DenseProblem& problem, const Assign2dResult& result);
  double typical_width(const DenseProblem& problem, std::span<const double> v);
  double ranked_offer(std::size_t rank);
  void want_pairs(const DenseProblem& problem,
                  std::span<const double> v,
                  std::uint32_t i,
                  double limit);
  void want_violated_pairs(const DenseProblem& problem, const Assign2dResult& result);
  void want_ways_out(const DenseProblem& problem, const Assign2dResult& result);
  bool extend_core(const DenseProblem& problem);

  // A pair as one number, so that pairs sort by row, then column.
  using Pair = std::uint64_t;

  SparseSolver sparse_;
  DenseSolver dense_;  // for what takes too many rounds
  FullMatrix matrix_;
  std::vector<Pair> core_;
  std::vector<Pair> wanted_;  // pairs to be added to it
  std::vector<Pair> merged_;
  std::vector<std::uint32_t> row_start_;  // the core as a sparse problem
  std::vector<std::uint32_t> column_;
  std::vector<double> cost_;
  std::vector<double> line_;            // offers of one row or column
  std::vector<double> widths_;          // of the sampled rows
  std::vector<double> block_least_;     // least offers of the row at hand
  std::vector<std::uint8_t> is_known_;  // partners of a Hall set
};

}  // namespace nda::lap
