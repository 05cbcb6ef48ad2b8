#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace nda::dual {

/// The convex quadratic program over the unit simplex that a bundle method solves at every step:
///
///     minimise  1/2 l'G l + a'l     so that     l >= 0,  sum l = 1.
///
/// `gram` is symmetric positive semidefinite, of any rank: duplicates are usual.
struct SimplexQpProblem {
  std::size_t size = 0;            ///< n >= 1
  std::span<const double> gram;    ///< G, element (i, j) at i * stride + j; both halves are read
  std::size_t stride = 0;          ///< >= size
  std::span<const double> linear;  ///< a, size entries

  double gram_at(std::size_t i, std::size_t j) const { return gram[i * stride + j]; }
};

/// What a solve returns besides the weights.
struct SimplexQpResult {
  double multiplier =
      0;               ///< mu = l'G l + a'l; at the solution (G l + a)_i >= mu, = mu where l_i > 0
  int iterations = 0;  ///< changes of the active set, or evaluations of the objective
  bool converged = false;  ///< false: `weights` is feasible, but the solver stopped early: at its
                           ///< limit of changes, or where entries overflow
};

/// Solvers of this program.  One object may be used for any number of programs.
class SimplexQp {
 public:
  virtual ~SimplexQp() = default;

  /// Solves `problem`.
  ///
  /// @param weights  size entries; on entry the guess to start from (negative entries count as 0, a
  ///                 sum of 0 as no guess), on return the solution: weights >= 0 with sum 1.
  virtual SimplexQpResult solve(const SimplexQpProblem& problem, std::span<double> weights) = 0;
};

/// Primal active-set method on a Cholesky factor of the support; exact up to rounding.
///
/// Cost: O(k^3 + n k) to take over a guess with k positive weights, then O(k^2 + n k) per change of
/// the support, at most 10 n + 50 of them whatever the entries.  No allocation once programs of the
/// same size have been solved.
/// Source: see simplex_qp.cpp.
class ActiveSetQp : public SimplexQp {
 public:
  ActiveSetQp();
  ~ActiveSetQp() override;
  SimplexQpResult solve(const SimplexQpProblem& problem, std::span<double> weights) override;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace nda::dual
