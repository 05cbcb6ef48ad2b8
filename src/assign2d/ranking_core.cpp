#include "assign2d/ranking_core.hpp"

#include <algorithm>

// An assignment costs what the best one costs plus its slack: the reduced costs of its pairs and of
// the outside options that it uses, none of them negative.  So a pair whose reduced cost exceeds
// `reach` is in no assignment within reach, and of a dense problem a few pairs a row are left.

namespace nda::lap {
namespace {

constexpr std::size_t kFewPairs = 12;  // a row, in the pool
constexpr std::uint32_t kSampledRows = 32;

void clear(PairLines& lines) {
  lines.start.assign(1, 0);
  lines.partner.clear();
  lines.cost.clear();
}

void end_line(PairLines& lines) {
  lines.start.push_back(static_cast<std::uint32_t>(lines.partner.size()));
}

}  // namespace

void RankingCore::start(const Assign2dProblem& problem,
                        std::span<const double> u,
                        std::span<const double> v) {
  problem_ = problem;
  u_ = u;
  v_ = v;
  pool_reach_ = -1;
}

// So far most rows must be looked through for a few pairs each: the mean over sampled rows.
double RankingCore::reach_of_few() const {
  const std::uint32_t num_rows = problem_.num_rows();
  if (problem_.cost.size() <= 2 * kFewPairs * num_rows) return kInfinity;
  std::vector<double> reduced;
  double sum = 0, count = 0;
  for (std::uint32_t i = 0; i < num_rows; i += 1 + num_rows / kSampledRows) {
    const std::uint32_t begin = problem_.row_start[i], end = problem_.row_start[i + 1];
    if (end - begin <= kFewPairs) continue;
    reduced.clear();
    for (std::uint32_t k = begin; k < end; ++k) {
      reduced.push_back(problem_.cost[k] - u_[i] - v_[problem_.column[k]]);
    }
    std::nth_element(reduced.begin(), reduced.begin() + kFewPairs, reduced.end());
    if (reduced[kFewPairs] == kInfinity) continue;
    sum += reduced[kFewPairs];
    ++count;
  }
  return count == 0 ? kInfinity : sum / count;
}

void RankingCore::fill_pool(double reach) {
  clear(pool_);
  pool_reduced_.clear();
  pool_reach_ = reach;
  pool_next_ = kInfinity;
  for (std::uint32_t i = 0; i < problem_.num_rows(); ++i) {
    const double u = u_[i];
    for (std::uint32_t k = problem_.row_start[i]; k < problem_.row_start[i + 1]; ++k) {
      const double reduced = problem_.cost[k] - u - v_[problem_.column[k]];
      if (reduced > reach) {
        pool_next_ = reduced < pool_next_ ? reduced : pool_next_;
      } else if (problem_.cost[k] < kInfinity) {
        pool_.partner.push_back(problem_.column[k]);
        pool_.cost.push_back(problem_.cost[k]);
        pool_reduced_.push_back(reduced);
      }
    }
    end_line(pool_);
  }
}

void RankingCore::select(double reach) {
  clear(by_row_);
  next_reach_ = pool_next_;
  for (std::uint32_t i = 0; i + 1 < pool_.start.size(); ++i) {
    for (std::uint32_t k = pool_.start[i]; k < pool_.start[i + 1]; ++k) {
      if (pool_reduced_[k] > reach) {
        next_reach_ = std::min(next_reach_, pool_reduced_[k]);
        continue;
      }
      by_row_.partner.push_back(pool_.partner[k]);
      by_row_.cost.push_back(pool_.cost[k]);
    }
    end_line(by_row_);
  }
}

void RankingCore::transpose() {
  std::vector<std::uint32_t>& start = by_column_.start;
  start.assign(problem_.num_columns() + 2, 0);
  by_column_.partner.resize(by_row_.partner.size());
  by_column_.cost.resize(by_row_.cost.size());
  for (const std::uint32_t j : by_row_.partner) ++start[j + 2];
  for (std::size_t j = 2; j < start.size(); ++j) start[j] += start[j - 1];
  for (std::uint32_t i = 0; i + 1 < by_row_.start.size(); ++i) {
    for (std::uint32_t k = by_row_.start[i]; k < by_row_.start[i + 1]; ++k) {
      const std::uint32_t at = start[by_row_.partner[k] + 1]++;
      by_column_.partner[at] = i;
      by_column_.cost[at] = by_row_.cost[k];
    }
  }
  start.pop_back();
}

double RankingCore::build_widely(double reach) {
  build(std::max(reach, reach_of_few()));
  return pool_reach_;
}

void RankingCore::build(double reach) {
  if (reach > pool_reach_) fill_pool(reach);
  select(reach);
  transpose();
}

}  // namespace nda::lap
