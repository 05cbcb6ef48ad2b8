// The bundle master as a general nonlinear program for NLopt: box [0, 1]^n, one linear equality.
//
// SLSQP works with a least-squares subproblem of its own and a BFGS matrix, so it does not know
// that the program is quadratic.  The objective is scaled to the size of its data before it is
// handed over: SLSQP's tests are absolute in places.  NLopt reports "roundoff limited" where
// progress ends in rounding; its last point is then still used, and `converged` is false.
#include "dual/nlopt_simplex_qp.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace nda::dual {
namespace {

struct Data {
  const SimplexQpProblem* problem = nullptr;
  double scale = 1;
};

// (G l)_i + a_i.
double partial(const SimplexQpProblem& problem, const double* l, std::size_t i) {
  double sum = problem.linear[i];
  for (std::size_t j = 0; j < problem.size; ++j) sum += problem.gram_at(i, j) * l[j];
  return sum;
}

double objective(unsigned n, const double* l, double* gradient, void* data) {
  const auto& [problem, scale] = *static_cast<const Data*>(data);
  double value = 0;
  for (unsigned i = 0; i < n; ++i) {
    const double g = partial(*problem, l, i);
    value += l[i] * (g + problem->linear[i]) / 2;
    if (gradient != nullptr) gradient[i] = g / scale;
  }
  return value / scale;
}

double excess(unsigned n, const double* l, double* gradient, void*) {
  if (gradient != nullptr) std::fill(gradient, gradient + n, 1.0);
  return std::accumulate(l, l + n, -1.0);
}

double scale_of(const SimplexQpProblem& problem) {
  double scale = 0;
  for (std::size_t i = 0; i < problem.size; ++i) {
    scale = std::max({scale, problem.gram_at(i, i), std::abs(problem.linear[i])});
  }
  return scale > 0 ? scale : 1;
}

void to_simplex(std::span<double> weights) {
  double sum = 0;
  for (double& w : weights) {
    w = std::max(0.0, w);
    sum += w;
  }
  for (double& w : weights) w = sum > 0 ? w / sum : 1.0 / static_cast<double>(weights.size());
}

}  // namespace

SimplexQpResult NloptSimplexQp::solve(const SimplexQpProblem& problem, std::span<double> weights) {
  Data data{&problem, scale_of(problem)};
  const auto n = static_cast<unsigned>(problem.size);
  to_simplex(weights);
  nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, n);
  nlopt_set_lower_bounds1(opt, 0);
  nlopt_set_upper_bounds1(opt, 1);
  nlopt_set_min_objective(opt, objective, &data);
  nlopt_add_equality_constraint(opt, excess, nullptr, 1e-12);
  nlopt_set_ftol_rel(opt, relative_tolerance_);
  nlopt_set_maxeval(opt, max_evaluations_);
  double value = 0;
  const nlopt_result code = nlopt_optimize(opt, weights.data(), &value);
  SimplexQpResult result;
  result.iterations = nlopt_get_numevals(opt);
  nlopt_destroy(opt);
  result.converged = code > 0 && code != NLOPT_MAXEVAL_REACHED;
  to_simplex(weights);
  for (std::size_t i = 0; i < problem.size; ++i) {
    result.multiplier += weights[i] * partial(problem, weights.data(), i);
  }
  return result;
}

}  // namespace nda::dual
