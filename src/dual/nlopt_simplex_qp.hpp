#pragma once

#include "dual/simplex_qp.hpp"

namespace nda::dual {

/// The same program by NLopt's SLSQP (Kraft 1988): a reference for tests of small programs.
///
/// It is slow (its cost per iteration grows like n^3, and it starts without a factor) and loses
/// accuracy with n, so nothing in the library solves with it by default.  The start is the guess,
/// or the centre of the simplex.
class NloptSimplexQp : public SimplexQp {
 public:
  /// Stops when the objective changes by less than `relative_tolerance`, or after
  /// `max_evaluations` evaluations of it.
  explicit NloptSimplexQp(double relative_tolerance = 1e-14, int max_evaluations = 2000)
      : relative_tolerance_(relative_tolerance), max_evaluations_(max_evaluations) {}

  SimplexQpResult solve(const SimplexQpProblem& problem, std::span<double> weights) override;

 private:
  double relative_tolerance_;
  int max_evaluations_;
};

}  // namespace nda::dual
