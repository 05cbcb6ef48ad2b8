#include "assign2d/core_solver.hpp"

#include <algorithm>

#include "assign2d/dense_kernels.hpp"
#include "assign2d/start.hpp"

// A dense optimum uses pairs that are among the cheapest of their row and column; the others only
// cost time. After Volgenant, "Linear and semi-assignment problems: a core oriented approach",
// Computers & Operations Research 23 (1996) 917-932: choose a core, solve it as a sparse problem,
// price out all pairs with its duals, add those of negative reduced cost and solve again, warm.
// Each round passes over the matrix once, a line at a time, which for large matrices is all that is
// left of the running time.
//
// Differences.  The core is not the cheapest k of each row but what lies within a width of the row
// minimum of c - v, v being the start prices (column reduction, or the former duals): a width that
// leaves about kCorePairs pairs in a typical row, found from a few sampled rows.  One pass with a
// rarely true test replaces a selection in every row; rows that get too few pairs choose their own
// width, rows of many ties are thinned evenly.  A core may be infeasible where the problem is not:
// its Hall set then receives its best pairs with partners it does not know yet, and is a proof of
// infeasibility if there are none.

namespace nda::lap {
namespace {

constexpr std::size_t kCorePairs = 12;   // in a typical row
constexpr std::size_t kFewestPairs = 4;  // in any row that has so many
constexpr std::size_t kMostPairs = 48;   // in any row at the start
constexpr std::uint32_t kSampledRows = 8;
constexpr int kMaxRounds = 50;
constexpr double kTolerance = 1e-14;  // of the largest cost

std::uint64_t pair_of(std::uint32_t i, std::uint32_t j) {
  return std::uint64_t{i} << 32 | j;
}

}  // namespace

// Every core that choose_core() can choose, and as many pairs again for later rounds.
void CoreSolver::reserve(const DenseProblem& problem) {
  const std::size_t members = std::max(problem.num_rows(), problem.num_columns());
  const std::size_t pairs =
      std::min(problem.cost.size(), 2 * kMostPairs * problem.num_rows()) + problem.num_columns();
  for (std::vector<Pair>* list : {&core_, &wanted_, &merged_}) list->reserve(pairs);
  row_start_.reserve(members + 1);
  column_.reserve(pairs);
  cost_.reserve(pairs);
  sparse_.reserve(pairs, members);
  line_.reserve(members);
  widths_.reserve(2 * kSampledRows);
  is_known_.reserve(members);
  block_least_.resize(num_blocks(problem.num_columns()));
}

// The offer of that rank (0 = least) in line_, whose order is lost.
double CoreSolver::ranked_offer(std::size_t rank) {
  const auto at = line_.begin() + static_cast<std::ptrdiff_t>(std::min(rank, line_.size() - 1));
  std::nth_element(line_.begin(), at, line_.end());
  return *at;
}

// Width above the row minimum that holds kCorePairs pairs, median of some rows.
double CoreSolver::typical_width(const DenseProblem& problem, std::span<const double> v) {
  const std::uint32_t stride = std::max(1u, problem.num_rows() / kSampledRows);
  widths_.clear();
  for (std::uint32_t i = stride / 2; i < problem.num_rows(); i += stride) {
    line_.resize(v.size());
    for (std::size_t j = 0; j < v.size(); ++j) line_[j] = problem.line(i)[j] - v[j];
    const double least = *std::min_element(line_.begin(), line_.end());
    const double highest = ranked_offer(kCorePairs - 1);
    if (highest < kInfinity) widths_.push_back(highest - least);
  }
  if (widths_.empty()) return 0;
  const auto middle = widths_.begin() + static_cast<std::ptrdiff_t>(widths_.size() / 2);
  std::nth_element(widths_.begin(), middle, widths_.end());
  return *middle;
}

// Wants the pairs of row i with c - v <= limit, evenly thinned if they are too many.  Needs
// block_least_ of the row: most blocks hold none.
void CoreSolver::want_pairs(const DenseProblem& problem,
                            std::span<const double> v,
                            std::uint32_t i,
                            double limit) {
  const double* c = problem.line(i);
  const std::size_t begin = wanted_.size();
  for (std::uint32_t first = 0; first < v.size(); first += kBlock) {
    if (!(block_least_[first / kBlock] <= limit)) continue;
    const std::uint32_t end = std::min(first + kBlock, problem.num_columns());
    for (std::uint32_t j = first; j < end; ++j) {
      if (c[j] - v[j] <= limit && c[j] < kInfinity) wanted_.push_back(pair_of(i, j));
    }
  }
  const std::size_t count = wanted_.size() - begin;
  if (count <= kMostPairs) return;
  const std::size_t step = (count + kMostPairs - 1) / kMostPairs;
  std::size_t kept = begin;
  for (std::size_t n = i % step; n < count; n += step) wanted_[kept++] = wanted_[begin + n];
  wanted_.resize(kept);
}

// Wants a core around the start prices; former mates (none after a cold start) belong to it, which
// keeps it feasible even if their prices are off.
void CoreSolver::choose_core(const DenseProblem& problem, const Assign2dResult& result) {
  core_.clear();
  wanted_.clear();
  const std::span<const double> v = result.v;
  if (v.empty()) return;
  const double width = typical_width(problem, v);
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const double* c = problem.line(i);
    const double least =
        std::min(line_least(c, v.data(), problem.num_columns(), block_least_.data()),
                 problem.row_outside[i]);
    if (least == kInfinity) continue;
    const std::size_t begin = wanted_.size();
    want_pairs(problem, v, i, least + width);
    if (wanted_.size() < begin + kFewestPairs) {
      wanted_.resize(begin);
      line_.resize(v.size());
      for (std::size_t j = 0; j < v.size(); ++j) line_[j] = c[j] - v[j];
      want_pairs(problem, v, i, ranked_offer(kCorePairs - 1));
    }
    const std::int32_t former = result.column_of_row[i];
    if (former != kUnassigned && c[former] < kInfinity) {
      wanted_.push_back(pair_of(i, static_cast<std::uint32_t>(former)));
    }
  }
}

// Adds the wanted pairs to the core and writes it as a sparse problem.  @return whether it has
// grown.
bool CoreSolver::extend_core(const DenseProblem& problem) {
  const std::size_t former_size = core_.size();
  std::sort(wanted_.begin(), wanted_.end());
  merged_.resize(core_.size() + wanted_.size());
  std::merge(core_.begin(), core_.end(), wanted_.begin(), wanted_.end(), merged_.begin());
  merged_.erase(std::unique(merged_.begin(), merged_.end()), merged_.end());
  std::swap(core_, merged_);
  wanted_.clear();
  row_start_.assign(problem.num_rows() + std::size_t{1}, 0);
  column_.resize(core_.size());
  cost_.resize(core_.size());
  for (std::size_t k = 0; k < core_.size(); ++k) {
    const std::uint32_t i = static_cast<std::uint32_t>(core_[k] >> 32);
    column_[k] = static_cast<std::uint32_t>(core_[k]);
    cost_[k] = problem.line(i)[column_[k]];
    ++row_start_[i + 1];
  }
  for (std::size_t i = 1; i < row_start_.size(); ++i) row_start_[i] += row_start_[i - 1];
  return core_.size() > former_size;
}

// Wants the pairs with u + v > c.
void CoreSolver::want_violated_pairs(const DenseProblem& problem, const Assign2dResult& result) {
  const double tolerance =
      kTolerance * std::max(largest_magnitude(cost_), largest_magnitude(result.v));
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const double limit = result.u[i] - tolerance;
    const double least =
        line_least(problem.line(i), result.v.data(), problem.num_columns(), block_least_.data());
    if (least < limit) {
      want_pairs(problem, result.v, i, limit);
    }
  }
}

// Wants the best pairs of the Hall set with partners that no member of it has in the core.
void CoreSolver::want_ways_out(const DenseProblem& problem, const Assign2dResult& result) {
  const bool is_rows = !result.hall_rows.empty();
  const std::vector<std::uint32_t>& hall = is_rows ? result.hall_rows : result.hall_columns;
  const std::uint32_t num_partners = is_rows ? problem.num_columns() : problem.num_rows();
  is_known_.assign(num_partners, 0);
  for (const Pair pair : core_) {
    const std::uint32_t i = static_cast<std::uint32_t>(pair >> 32);
    const std::uint32_t j = static_cast<std::uint32_t>(pair);
    const bool is_member = std::binary_search(hall.begin(), hall.end(), is_rows ? i : j);
    if (is_member) is_known_[is_rows ? j : i] = 1;
  }
  for (const std::uint32_t member : hall) {
    const auto offer = [&](std::uint32_t p) {
      if (is_known_[p] != 0) return kInfinity;
      return is_rows ? problem.line(member)[p] - result.v[p]
                     : problem.line(p)[member] - result.u[p];
    };
    line_.resize(num_partners);
    for (std::uint32_t p = 0; p < num_partners; ++p) line_[p] = offer(p);
    const double limit = num_partners == 0 ? kInfinity : ranked_offer(kFewestPairs);
    for (std::uint32_t p = 0; p < num_partners; ++p) {
      if (offer(p) > limit || offer(p) == kInfinity) continue;
      wanted_.push_back(is_rows ? pair_of(member, p) : pair_of(p, member));
    }
  }
}

void CoreSolver::solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm) {
  reserve(problem);
  const DenseView view{problem.cost.data(), problem.column_outside.size()};
  start(view,
        problem.cost,
        problem.row_outside,
        problem.column_outside,
        ColdStart::kMiddle,
        result,
        warm);
  choose_core(problem, result);
  extend_core(problem);
  for (int round = 0; round < kMaxRounds; ++round) {
    result.feasible = true;  // prices are a valid start even where the core was infeasible
    sparse_.solve_warm({row_start_, column_, cost_, problem.row_outside, problem.column_outside},
                       result);
    if (result.feasible) {
      want_violated_pairs(problem, result);
    } else {
      want_ways_out(problem, result);
    }
    if (!extend_core(problem)) return;
  }
  dense_.solve_matrix(problem, result, result.feasible);
}

}  // namespace nda::lap
