#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/side.hpp"
#include "assign2d/sparse_paths.hpp"
#include "assign2d/transpose.hpp"

namespace nda::lap {

/// Shortest augmenting paths on the pairs as they are stored.
class SparseSolver final : public Assign2dSolver {
 public:
  /// Room for problems of so many pairs and members of a side.
  void reserve(std::size_t num_pairs, std::size_t num_members) {
    transpose_.reserve(num_pairs, num_members);
  }
  void set_stop(const std::function<bool()>* stop) override { paths_.set_stop(stop); }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override;
  void match_tight_pairs(const Assign2dProblem& problem, Assign2dResult& result);
  bool serve(const Assign2dProblem& problem, Assign2dResult& result);

  SparsePaths paths_;
  Transpose transpose_;
  std::vector<std::uint32_t> pair_of_row_;  // also guesses where the former mates are
};

}  // namespace nda::lap
