// The bundle as numbers: subgradients in buffers that never move, everything else in small arrays.
//
// The Gram matrix carries almost all the work.  A new subgradient costs one dot product per kept
// one; linearisation errors after a move of the centre, slopes along a step and the row of the
// aggregate all follow from the matrix without touching an n-vector.  The aggregate is stored by
// exchanging buffers, so compression (Kiwiel 1983; Schramm & Zowe, section 4) copies nothing
// either.
#include "dual/bundle.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace nda::dual {
namespace {

using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;

ConstVector as_vector(std::span<const double> v) {
  return {v.data(), static_cast<Eigen::Index>(v.size())};
}

// Numbers that stay in the first-level cache while all columns are added up.
constexpr std::size_t kChunk = 1024;

// Planes this far above the others have no part in any solution; more would overflow in sums.
constexpr double kMostLinear = 1e300;

}  // namespace

Bundle::Bundle(std::size_t num_variables, std::size_t capacity, std::size_t evaluations)
    : n_(num_variables),
      capacity_(capacity),
      num_evaluations_(evaluations),
      columns_(capacity + 2),
      spare_(capacity),
      aggregate_(capacity + 1),
      gram_(capacity * capacity),
      errors_(capacity),
      linear_(capacity),
      weights_(capacity),
      slopes_(capacity),
      row_(capacity),
      unused_(capacity),
      origin_(capacity, std::vector<double>(evaluations)) {
  for (std::size_t i = 0; i < capacity; ++i) slot_.push_back(i);
}

void Bundle::measure_candidate() {
  const ConstVector g = as_vector(column(spare_));
  candidate_norm2_ = g.squaredNorm();
  candidate_slope_ = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    row_[i] = g.dot(as_vector(column(slot_[i])));
    candidate_slope_ += step_ * weights_[i] * row_[i];
  }
}

double Bundle::candidate_reach() const {
  return step_ * std::sqrt(candidate_norm2_ * norm2_);
}

void Bundle::insert_candidate(double error, int evaluation) {
  const std::size_t position = size_ < capacity_ ? size_++ : make_room();
  std::swap(slot_[position], spare_);
  for (std::size_t i = 0; i < size_; ++i) gram(i, position) = gram(position, i) = row_[i];
  gram(position, position) = candidate_norm2_;
  errors_[position] = std::max(0.0, error);
  weights_[position] = size_ == 1 ? 1 : 0;
  unused_[position] = 0;
  if (num_evaluations_ == 0) return;
  std::fill(origin_[position].begin(), origin_[position].end(), 0.0);
  origin_[position][static_cast<std::size_t>(evaluation) - 1] = 1;
}

// The position the candidate may take.
std::size_t Bundle::make_room() {
  const std::size_t unused = longest_unused();
  if (unused < size_) return unused;
  const std::size_t first = lightest(size_);
  const std::size_t second = lightest(first);
  store_aggregate(first);
  return second;
}

std::size_t Bundle::longest_unused() const {
  std::size_t best = size_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (unused_[i] == 0) continue;
    if (best == size_ || unused_[i] > unused_[best] ||
        (unused_[i] == unused_[best] && errors_[i] > errors_[best])) {
      best = i;
    }
  }
  return best;
}

std::size_t Bundle::lightest(std::size_t except) const {
  std::size_t best = size_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (i != except && (best == size_ || weights_[i] < weights_[best])) best = i;
  }
  return best;
}

void Bundle::store_aggregate(std::size_t position) {
  if (num_evaluations_ > 0) origin_[position] = primal_weights();
  row_[position] = candidate_slope_ / step_;
  for (std::size_t i = 0; i < size_; ++i) gram(i, position) = gram(position, i) = slopes_[i];
  gram(position, position) = norm2_;
  errors_[position] = error_;
  unused_[position] = 0;
  std::swap(slot_[position], aggregate_);
  std::fill(weights_.begin(), weights_.end(), 0.0);
  weights_[position] = 1;
}

void Bundle::move_centre(double increase) {
  for (std::size_t i = 0; i < size_; ++i) {
    errors_[i] = std::max(0.0, errors_[i] + step_ * slopes_[i] - increase);
  }
  error_ = std::max(0.0, error_ + step_ * norm2_ - increase);
}

bool Bundle::solve(double t) {
  step_ = t;
  for (std::size_t i = 0; i < size_; ++i) linear_[i] = std::min(errors_[i] / t, kMostLinear);
  const SimplexQpResult result =
      qp_.solve({size_, gram_, capacity_, linear_}, {weights_.data(), size_});
  combine();
  norm2_ = as_vector(column(aggregate_)).squaredNorm();
  error_ = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    error_ += weights_[i] * errors_[i];
    unused_[i] = weights_[i] > 0 ? 0 : unused_[i] + 1;
    slopes_[i] = 0;
    for (std::size_t j = 0; j < size_; ++j) slopes_[i] += weights_[j] * gram(i, j);
  }
  return result.converged;
}

// aggregate = sum of weights_[i] g[i], one chunk of rows after the other.
void Bundle::combine() {
  const std::span<double> sum = column(aggregate_);
  for (std::size_t begin = 0; begin < n_; begin += kChunk) {
    const std::size_t count = std::min(kChunk, n_ - begin);
    Vector part(sum.data() + begin, static_cast<Eigen::Index>(count));
    part.setZero();
    for (std::size_t i = 0; i < size_; ++i) {
      if (weights_[i] > 0) {
        part += weights_[i] * as_vector(column(slot_[i]).subspan(begin, count));
      }
    }
  }
}

std::vector<double> Bundle::primal_weights() const {
  std::vector<double> sum(num_evaluations_);
  for (std::size_t i = 0; i < size_ && num_evaluations_ > 0; ++i) {
    for (std::size_t e = 0; e < num_evaluations_; ++e) sum[e] += weights_[i] * origin_[i][e];
  }
  return sum;
}

}  // namespace nda::dual
