#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/side.hpp"
#include "assign2d/sparse_solver.hpp"
#include "assign2d/stop_check.hpp"
#include "assign2d/transpose.hpp"

namespace nda::lap {

/// Forward/reverse auction with epsilon scaling; the last digits come from shortest paths.
class AuctionSolver final : public Assign2dSolver {
 public:
  void set_stop(const std::function<bool()>* stop) override {
    stop_check_.set(stop);
    finisher_.set_stop(stop);
  }

 private:
  void do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) override;
  bool run_round(const Assign2dProblem& problem, double epsilon, Assign2dResult& result);
  template <class View>
  bool hold_auction(const Phase<View>& phase, double epsilon);

  StopCheck stop_check_;
  Transpose transpose_;
  SparseSolver finisher_;
  std::vector<std::uint32_t> pair_of_row_;
  std::vector<std::uint32_t> bidders_;
  double span_ = 0;  // no two offers of a member differ by more for a reason
};

}  // namespace nda::lap
