// A primal active-set method for the bundle master problem.
//
// The idea is Wolfe's (Finding the nearest point in a polytope, Math. Programming 11, 1976),
// carried over to a linear term by Kiwiel (IMA J. Numer. Anal. 6, 1986) and Frangioni (Computers &
// OR 23, 1996): keep a support S on which the weights are positive and stationary, let the index
// with the most negative reduced gradient enter, move towards the minimiser over the affine hull of
// the new S, and drop whatever weight reaches zero on the way.
//
// Singular Gram matrices are the rule here, because evaluations repeat subgradients.  Two things
// make them harmless.  First, G is replaced by G + rho e e', which adds a constant on the simplex
// and makes G_SS positive definite as soon as the subgradients in S are affinely independent.
// Second, an index that is (numerically) an affine combination of S never enters the factor:
// trading it against that combination changes the objective linearly, downhill, so the trade goes
// on until a weight of S vanishes; that one leaves, and the entering index takes its place.  So S
// stays affinely independent, and no pivot is ever near zero.  The base handling of Kiwiel and
// Frangioni is more general (it keeps a singular base); the exchange is shorter and, on a simplex,
// enough.
//
// The factor L of G_SS + rho e e' grows by a row when an index enters and is restored by Givens
// rotations when one leaves.  It is built afresh in every call: with 5 to 20 positive weights that
// costs less than to find out what the caller changed.
#include "dual/simplex_qp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nda::dual {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// An index whose pivot is below this fraction of its diagonal is a combination of the support.
constexpr double kFlat = 1e-13;
/// Reduced gradients above -kOptimal * (size of their terms) count as nonnegative.
constexpr double kOptimal = 32 * kEpsilon;
/// Weights whose sum is farther from 1 come from overflow or underflow.
constexpr double kSumError = 1e-9;

}  // namespace

class ActiveSetQp::Solver {
 public:
  SimplexQpResult solve(const SimplexQpProblem& problem, std::span<double> weights);

 private:
  void reserve(std::size_t size);
  void set_shift(std::span<const double> weights);
  void take_guess(std::span<const double> weights);
  void start_from_best_vertex();
  bool append(std::size_t index);
  void remove(std::size_t position);
  void restore_triangle(std::size_t position);
  void set_descent();
  void make_stationary();
  void solve_with_sum(double sum, std::span<double> b);
  void express(std::size_t index);
  bool enter(std::size_t index);
  std::size_t blocking(double limit, double* step) const;
  void move(double step);
  void update_gradient();
  std::size_t most_negative() const;
  bool is_feasible() const;
  bool is_finite() const;
  std::size_t best_vertex() const;
  void solve_lower(std::span<double> x) const;
  void solve_upper(std::span<double> x) const;

  double* row(std::size_t i) { return factor_.data() + i * capacity_; }
  const double* row(std::size_t i) const { return factor_.data() + i * capacity_; }
  double shifted(std::size_t i, std::size_t j) const { return problem_.gram_at(i, j) + shift_; }
  std::span<double> front(std::vector<double>& v) { return {v.data(), support_.size()}; }

  SimplexQpProblem problem_;
  std::size_t capacity_ = 0;
  double shift_ = 0;                  // rho
  double multiplier_ = 0;             // mu
  std::vector<std::size_t> support_;  // S, in the order of the factor
  std::vector<char> is_support_;      // per index
  std::vector<double> factor_;        // L, row-major, stride capacity_
  std::vector<double> value_;         // weights of S
  std::vector<double> direction_;     // change of the weights of S along the line
  std::vector<double> ones_;          // L^-1 e
  std::vector<double> gradient_;      // G l + a, per index
  std::vector<double> terms_;         // size of the terms that gradient_ is the sum of
};

void ActiveSetQp::Solver::reserve(std::size_t size) {
  support_.clear();
  is_support_.assign(size, 0);
  if (size <= capacity_) return;
  capacity_ = size;
  support_.reserve(size);
  factor_.resize(size * size);
  for (auto* v : {&value_, &direction_, &ones_, &gradient_, &terms_}) v->resize(size);
}

// rho = the size of G where the solution is expected: on the support of the guess.  The steepest
// subgradient of all may be orders of magnitude longer, and its rho would swamp G_SS.
void ActiveSetQp::Solver::set_shift(std::span<const double> weights) {
  shift_ = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < problem_.size; ++i) {
    const double norm2 = problem_.gram_at(i, i);
    if (weights[i] > 0) shift_ = std::max(shift_, norm2);
    if (norm2 > 0) least = std::min(least, norm2);
  }
  if (shift_ == 0) shift_ = std::isfinite(least) ? least : 1;
}

void ActiveSetQp::Solver::solve_lower(std::span<double> x) const {
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double* l = row(i);
    double sum = x[i];
    for (std::size_t j = 0; j < i; ++j) sum -= l[j] * x[j];
    x[i] = sum / l[i];
  }
}

void ActiveSetQp::Solver::solve_upper(std::span<double> x) const {
  for (std::size_t i = x.size(); i-- > 0;) {
    const double* l = row(i);
    x[i] /= l[i];
    for (std::size_t j = 0; j < i; ++j) x[j] -= l[j] * x[i];
  }
}

// Adds a row to the factor; false if `index` is affinely dependent on the support.
bool ActiveSetQp::Solver::append(std::size_t index) {
  const std::size_t k = support_.size();
  double* l = row(k);
  for (std::size_t i = 0; i < k; ++i) l[i] = shifted(index, support_[i]);
  solve_lower({l, k});
  double pivot = shifted(index, index);
  const double flat = kFlat * pivot;
  for (std::size_t i = 0; i < k; ++i) pivot -= l[i] * l[i];
  if (pivot <= flat) return false;
  l[k] = std::sqrt(pivot);
  support_.push_back(index);
  is_support_[index] = 1;
  return true;
}

void ActiveSetQp::Solver::remove(std::size_t position) {
  is_support_[support_[position]] = 0;
  support_.erase(support_.begin() + static_cast<std::ptrdiff_t>(position));
  for (auto* v : {&value_, &direction_}) {
    std::copy(v->begin() + static_cast<std::ptrdiff_t>(position) + 1,
              v->begin() + static_cast<std::ptrdiff_t>(support_.size()) + 1,
              v->begin() + static_cast<std::ptrdiff_t>(position));
  }
  restore_triangle(position);
}

// Rows below `position` move up by one; rotations of neighbouring columns clear what then stands
// to the right of the diagonal.
void ActiveSetQp::Solver::restore_triangle(std::size_t position) {
  const std::size_t k = support_.size();
  for (std::size_t i = position; i < k; ++i) {
    std::copy(row(i + 1), row(i + 1) + i + 2, row(i));
  }
  for (std::size_t j = position; j < k; ++j) {
    const double a = row(j)[j];
    const double b = row(j)[j + 1];
    const double radius = std::hypot(a, b);
    const double c = a / radius;
    const double s = b / radius;
    row(j)[j] = radius;
    for (std::size_t i = j + 1; i < k; ++i) {
      double* r = row(i);
      const double x = r[j];
      r[j] = c * x + s * r[j + 1];
      r[j + 1] = c * r[j + 1] - s * x;
    }
  }
}

std::size_t ActiveSetQp::Solver::best_vertex() const {
  std::size_t best = 0;
  double best_value = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < problem_.size; ++i) {
    const double value = problem_.gram_at(i, i) / 2 + problem_.linear[i];
    if (value < best_value) {
      best_value = value;
      best = i;
    }
  }
  return best;
}

void ActiveSetQp::Solver::start_from_best_vertex() {
  append(best_vertex());
  value_[0] = 1;
}

// False where entries that overflow or vanish left no weights that make sense.
bool ActiveSetQp::Solver::is_feasible() const {
  double sum = 0;
  for (std::size_t i = 0; i < support_.size(); ++i) sum += value_[i];
  return std::abs(sum - 1) <= kSumError && std::isfinite(multiplier_);
}

void ActiveSetQp::Solver::take_guess(std::span<const double> weights) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0) || !append(i)) continue;
    value_[support_.size() - 1] = weights[i];
    sum += weights[i];
  }
  if (support_.empty()) {
    start_from_best_vertex();
    return;
  }
  for (double& value : front(value_)) value /= sum;
}

// Replaces b by the solution x of (G_SS + rho e e') x = b + nu e with sum x = `sum`.
void ActiveSetQp::Solver::solve_with_sum(double sum, std::span<double> b) {
  const std::span<double> ones = front(ones_);
  std::fill(ones.begin(), ones.end(), 1.0);
  solve_lower(b);
  solve_lower(ones);
  double norm = 0;
  double projection = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    norm += ones[i] * ones[i];
    projection += ones[i] * b[i];
  }
  const double level = (sum - projection) / norm;
  for (std::size_t i = 0; i < b.size(); ++i) b[i] += level * ones[i];
  solve_upper(b);
}

// direction_ = minus the gradient on S, up to a constant.
void ActiveSetQp::Solver::set_descent() {
  const std::span<double> descent = front(direction_);
  const double base = problem_.linear[support_[0]];
  for (std::size_t i = 0; i < descent.size(); ++i) {
    const double* g = problem_.gram.data() + support_[i] * problem_.stride;
    double sum = problem_.linear[support_[i]] - base;
    for (std::size_t j = 0; j < descent.size(); ++j) sum += value_[j] * g[support_[j]];
    descent[i] = -sum;
  }
}

// Moves the weights of S towards the minimiser over the affine hull of S until it is reached,
// dropping every weight that hits zero on the way.  Working with the change of the weights makes
// every round a step of iterative refinement as well.
void ActiveSetQp::Solver::make_stationary() {
  while (support_.size() > 1) {
    set_descent();
    solve_with_sum(0, front(direction_));
    double step = 0;
    const std::size_t leaving = blocking(1, &step);
    move(step);
    if (leaving == support_.size()) return;
    remove(leaving);
  }
  value_[0] = 1;
}

// The weight that vanishes first along direction_, or the size of S if none does up to `limit`.
std::size_t ActiveSetQp::Solver::blocking(double limit, double* step) const {
  std::size_t leaving = support_.size();
  *step = limit;
  for (std::size_t i = 0; i < support_.size(); ++i) {
    if (direction_[i] >= 0 || value_[i] + *step * direction_[i] > 0) continue;
    *step = -value_[i] / direction_[i];
    leaving = i;
  }
  return leaving;
}

void ActiveSetQp::Solver::move(double step) {
  for (std::size_t i = 0; i < support_.size(); ++i) value_[i] += step * direction_[i];
}

// Sets direction_ to the change of the weights of S that replaces one unit of `index`, which is an
// affine combination of S.
void ActiveSetQp::Solver::express(std::size_t index) {
  const std::span<double> change = front(direction_);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = -shifted(index, support_[i]);
  solve_with_sum(-1, change);
}

// Lets `index` enter the support; false if it had to leave again at once, which is rounding.
bool ActiveSetQp::Solver::enter(std::size_t index) {
  double weight = 0;
  while (!append(index)) {
    express(index);
    double step = 0;
    const std::size_t leaving = blocking(std::numeric_limits<double>::infinity(), &step);
    if (leaving == support_.size()) return false;
    move(step);
    weight += step;
    remove(leaving);
  }
  value_[support_.size() - 1] = weight;
  make_stationary();
  return is_support_[index] != 0;
}

void ActiveSetQp::Solver::update_gradient() {
  double size = 0;
  for (std::size_t i = 0; i < support_.size(); ++i) {
    size += value_[i] * std::sqrt(problem_.gram_at(support_[i], support_[i]));
  }
  for (std::size_t j = 0; j < problem_.size; ++j) {
    const double* g = problem_.gram.data() + j * problem_.stride;
    double sum = problem_.linear[j];
    for (std::size_t i = 0; i < support_.size(); ++i) sum += value_[i] * g[support_[i]];
    gradient_[j] = sum;
    terms_[j] = std::abs(problem_.linear[j]) + size * std::sqrt(g[j]);
  }
  multiplier_ = 0;
  for (std::size_t i = 0; i < support_.size(); ++i) {
    multiplier_ += value_[i] * gradient_[support_[i]];
  }
}

std::size_t ActiveSetQp::Solver::most_negative() const {
  std::size_t best = problem_.size;
  double best_slope = 0;
  for (std::size_t j = 0; j < problem_.size; ++j) {
    if (is_support_[j]) continue;
    const double slope = gradient_[j] - multiplier_;
    if (slope < best_slope && slope < -kOptimal * (terms_[j] + std::abs(multiplier_))) {
      best_slope = slope;
      best = j;
    }
  }
  return best;
}

bool ActiveSetQp::Solver::is_finite() const {
  return std::all_of(terms_.begin(),
                     terms_.begin() + static_cast<std::ptrdiff_t>(problem_.size),
                     [](double term) { return std::isfinite(term); });
}

SimplexQpResult ActiveSetQp::Solver::solve(const SimplexQpProblem& problem,
                                           std::span<double> weights) {
  problem_ = problem;
  reserve(problem.size);
  set_shift(weights);
  take_guess(weights);
  make_stationary();
  SimplexQpResult result;
  const int limit = 10 * static_cast<int>(problem.size) + 50;
  update_gradient();
  while (result.iterations < limit) {
    const std::size_t index = most_negative();
    result.converged = index == problem_.size;
    if (result.converged) break;
    ++result.iterations;
    const bool entered = enter(index);
    update_gradient();
    if (!entered) break;
  }
  // Against terms that overflow every gradient is small.
  result.converged = result.converged && is_finite();
  std::fill(weights.begin(), weights.end(), 0.0);
  if (!is_feasible()) {
    const std::size_t vertex = best_vertex();
    weights[vertex] = 1;
    return {problem.gram_at(vertex, vertex) + problem.linear[vertex], result.iterations, false};
  }
  for (std::size_t i = 0; i < support_.size(); ++i) weights[support_[i]] = std::max(0.0, value_[i]);
  result.multiplier = multiplier_;
  return result;
}

ActiveSetQp::ActiveSetQp() : solver_(std::make_unique<Solver>()) {}
ActiveSetQp::~ActiveSetQp() = default;

SimplexQpResult ActiveSetQp::solve(const SimplexQpProblem& problem, std::span<double> weights) {
  return solver_->solve(problem, weights);
}

}  // namespace nda::dual
