#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dual/simplex_qp.hpp"

namespace nda::dual {

/// The subgradients a bundle method keeps, as a cutting-plane model of q around a centre c:
///
///     q(c + d)  <=  q(c) + min over i of ( error[i] + g[i]'d ),
///
/// together with the solution of the proximal master problem
///
///     max over d of  min over i of ( error[i] + g[i]'d )  -  |d|^2 / (2 t),
///
/// namely d = t * aggregate, aggregate = sum of weight[i] g[i], with weights that minimise
/// t/2 |sum l_i g_i|^2 + sum l_i error_i over the simplex.
///
/// Memory: (size + 2) n numbers at most, each n when first needed.
class Bundle {
 public:
  /// `evaluations` = 0, or how many evaluations the primal weights must be able to name.
  Bundle(std::size_t num_variables, std::size_t capacity, std::size_t evaluations);

  std::size_t size() const { return size_; }

  /// Where the oracle writes the next subgradient.
  std::span<double> candidate() { return column(spare_); }

  /// Measures the subgradient in candidate() against those kept: `size()` dot products.
  void measure_candidate();

  /// candidate'd for the d of the last solve.
  double candidate_slope() const { return candidate_slope_; }

  /// |candidate| |d|: the size of the terms of candidate_slope().
  double candidate_reach() const;

  /// Keeps the candidate, with its linearisation error at the centre.  When full, drops the
  /// subgradient unused for longest; if all are in use, replaces one by the aggregate.
  void insert_candidate(double error, int evaluation);

  /// The centre moves to c + d of the last solve, where q is larger by `increase`.
  void move_centre(double increase);

  /// Solves the master problem with step parameter t > 0; false if what it found is feasible, but
  /// perhaps not the solution (SimplexQpResult::converged).
  bool solve(double t);

  double step() const { return step_; }              ///< t of the last solve
  double aggregate_norm2() const { return norm2_; }  ///< |aggregate|^2
  double aggregate_error() const { return error_; }  ///< sum of weight[i] error[i]
  double predicted_increase() const { return step_ * norm2_ + error_; }  ///< model(d) - q(c)
  double master_value() const { return step_ * norm2_ / 2 + error_; }    ///< optimum of the master
  std::span<const double> aggregate() const { return {columns_[aggregate_].data(), n_}; }

  /// The aggregate as a combination of the evaluations; empty unless asked for.
  std::vector<double> primal_weights() const;

 private:
  std::span<double> column(std::size_t i) {
    if (columns_[i].size() < n_) columns_[i].resize(n_);
    return columns_[i];
  }
  double& gram(std::size_t i, std::size_t j) { return gram_[i * capacity_ + j]; }
  void combine();
  std::size_t make_room();
  std::size_t longest_unused() const;
  std::size_t lightest(std::size_t except) const;
  void store_aggregate(std::size_t position);

  std::size_t n_;
  std::size_t capacity_;
  std::size_t num_evaluations_;
  std::size_t size_ = 0;
  std::vector<std::vector<double>> columns_;  // capacity_ + 2 buffers of n_ numbers, or none yet
  std::vector<std::size_t> slot_;             // position in the bundle -> buffer
  std::size_t spare_;                         // buffer of the candidate
  std::size_t aggregate_;                     // buffer of the aggregate
  std::vector<double> gram_;                  // capacity_ x capacity_
  std::vector<double> errors_;
  std::vector<double> linear_;  // errors_ / t
  std::vector<double> weights_;
  std::vector<double> slopes_;               // g[i]'aggregate
  std::vector<double> row_;                  // candidate'g[i]
  std::vector<int> unused_;                  // solves since the weight was positive
  std::vector<std::vector<double>> origin_;  // position -> weights of the evaluations
  double candidate_norm2_ = 0;
  double candidate_slope_ = 0;
  double step_ = 0;
  double norm2_ = 0;
  double error_ = 0;
  ActiveSetQp qp_;
};

}  // namespace nda::dual
