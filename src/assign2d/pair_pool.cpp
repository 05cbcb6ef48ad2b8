#include "assign2d/pair_pool.hpp"

#include <algorithm>

// An assignment costs what the best one costs plus its slack: the reduced costs of its pairs and of
// the outside options that it uses, none of them negative.  So a pair whose reduced cost exceeds
// some reach is in no assignment within that reach, and of a dense problem a few pairs a row are
// left.

namespace nda::lap {
namespace {

constexpr std::size_t kFewPairs = 12;  // a row
constexpr std::uint32_t kSampledRows = 32;

}  // namespace

void PairPool::start(const Assign2dProblem& problem, const Assign2dResult& best) {
  problem_ = problem;
  best_ = best;
  reach_ = -1;
}

// The mean of the reduced costs at that rank, over a sample of the rows.
double PairPool::reach_of_few() const {
  const std::uint32_t num_rows = problem_.num_rows();
  if (problem_.cost.size() <= 2 * kFewPairs * num_rows) return kInfinity;
  std::vector<double> reduced;
  double sum = 0, count = 0;
  for (std::uint32_t i = 0; i < num_rows; i += 1 + num_rows / kSampledRows) {
    reduced.clear();
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      reduced.push_back(problem_.cost[k] - best_.u[i] - best_.v[problem_.column[k]]);
    }
    if (reduced.size() <= kFewPairs) continue;
    std::nth_element(reduced.begin(), reduced.begin() + kFewPairs, reduced.end());
    if (reduced[kFewPairs] == kInfinity) continue;
    sum += std::max(0.0, reduced[kFewPairs]);
    ++count;
  }
  return count == 0 ? kInfinity : sum / count;
}

void PairPool::fill(double reach) {
  if (reach <= reach_) return;
  reach_ = reach;
  next_ = kInfinity;
  start_.assign(1, 0);
  column_.clear();
  cost_.clear();
  reduced_.clear();
  for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) {
    const double u = best_.u[i];
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const double reduced = problem_.cost[k] - u - best_.v[problem_.column[k]];
      if (reduced > reach) {
        next_ = reduced < next_ ? reduced : next_;
      } else if (problem_.cost[k] < kInfinity) {
        column_.push_back(problem_.column[k]);
        cost_.push_back(problem_.cost[k]);
        reduced_.push_back(std::max(0.0, reduced));
      }
    }
    start_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
}

double PairPool::next_reach(double reach) const {
  double next = next_;
  for (const double reduced : reduced_) {
    if (reduced > reach && reduced < next) next = reduced;
  }
  return next;
}

}  // namespace nda::lap
