#include "core/shift.hpp"

#include <algorithm>
#include <cmath>

#include "core/min_max.hpp"
#include "core/slices.hpp"
#include "core/use_bounds.hpp"

// How high must the penalty of a forbidden singleton be?  Write |c_a| / (number of real indices of
// a) for the share of an index in arc a, and w_i for the largest share of index i over its arcs and
// its singleton.  No solution costs more than W = sum w_i or less than -W, so penalty > 2 W makes
// leaving a forbidden index uncovered dearer than any solution that covers all of them.  It is
// rounded up to an integer so that costs on a grid stay on it.

namespace nda::core {
namespace {

using Table = std::vector<std::vector<double>>;

// Empty where the deadline strikes.
Table largest_shares(const Problem& problem, const Deadline& deadline) {
  Table share(static_cast<std::size_t>(problem.num_dimensions()));
  for (std::size_t k = 0; k < share.size(); ++k) {
    for (const double cost : problem.singleton_costs(static_cast<int>(k))) {
      share[k].push_back(cost < kInfinity ? std::abs(cost) : 0.0);
    }
  }
  const auto note_arc = [&](std::size_t a) {
    int real = 0;
    for (int k = 0; k < problem.num_dimensions(); ++k) real += problem.indices(k)[a] != 0;
    const double part = std::abs(problem.costs()[a]) / real;
    for (std::size_t k = 0; k < share.size(); ++k) {
      const Index i = problem.indices(static_cast<int>(k))[a];
      if (i != 0) share[k][i] = std::max(share[k][i], part);
    }
  };
  if (!for_each_until(deadline, problem.num_arcs(), note_arc)) return {};
  return share;
}

double make_penalty(const Problem& problem, const Deadline& deadline) {
  double total = 0;
  double largest = 0;
  const Table shares = largest_shares(problem, deadline);
  if (shares.empty()) return 0;
  for (const std::vector<double>& row : shares) {
    for (const double share : row) {
      total += share;
      largest = std::max(largest, share);
    }
  }
  const double penalty = 2 * total + largest;
  if (penalty == 0) return 1;
  return penalty >= 1 ? std::ceil(penalty) : penalty;
}

// Is x = 10^d c within rounding of an integer?  |c| 2^-52 is one rounding of c and one of the
// product.  Larger ones are steps that no checker of a proof counts.
bool on_grid(double cost, double scale) {
  const double x = cost * scale;
  return std::abs(x) < 0x1p50 && std::abs(x - std::nearbyint(x)) <= std::abs(x) * 0x1p-52;
}

template <typename Predicate>
bool all_costs(const Problem& problem, const Deadline& deadline, Predicate&& holds) {
  const auto costs = problem.costs();
  for (std::size_t a = 0; a < costs.size(); ++a) {
    if (a % kSlice == 0 && deadline.reached()) return false;
    if (!holds(costs[a])) return false;
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (const double cost : problem.singleton_costs(k)) {
      if (cost < kInfinity && !holds(cost)) return false;
    }
  }
  return true;
}

}  // namespace

bool has_forbidden_singleton(const Problem& problem) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto costs = problem.singleton_costs(k);
    if (std::find(costs.begin(), costs.end(), kInfinity) != costs.end()) return true;
  }
  return false;
}

Shift make_shift(const Problem& problem, const Deadline& deadline, double most_penalty) {
  require_single_uses(problem, "the cost shift");
  Shift shift;
  if (has_forbidden_singleton(problem)) {
    const double enough = make_penalty(problem, deadline);
    shift.penalty = std::min(enough, std::ceil(most_penalty));
    shift.is_enough = shift.penalty == enough;
  }
  std::uint32_t next = 0;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    shift.offset.push_back(next);
    next += problem.size(k) + 1;
    std::vector<double>& base = shift.base.emplace_back();
    for (const double cost : problem.singleton_costs(k)) {
      base.push_back(cost < kInfinity ? cost : shift.penalty);
      shift.constant += base.back();
    }
    if (std::any_of(base.begin(), base.end(), [](double charge) { return charge != 0; }))
      shift.charged.push_back(k);
  }
  return shift;
}

CostGrid find_grid(const Problem& problem, const Deadline& deadline) {
  double scale = 1;
  for (int digits = 0; digits <= 9; ++digits, scale *= 10) {
    double largest = 0;
    const auto fits = [&](double cost) {
      largest = max_of(largest, std::abs(cost));
      return on_grid(cost, scale);
    };
    if (all_costs(problem, deadline, fits)) return {1 / scale, digits == 0, largest};
  }
  return {};
}

}  // namespace nda::core
