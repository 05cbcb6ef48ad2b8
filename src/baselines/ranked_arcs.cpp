#include "baselines/ranked_arcs.hpp"

#include <algorithm>

// Every heuristic here scans the arcs from best to worst, often many times, and asks of each
// whether its indices are free.  So the arcs are sorted once and their slots laid out in that
// order, dummies left out: a scan then reads memory forwards.

namespace nda::baselines {
namespace {

Value value_of(const Problem& problem, std::size_t a) {
  Value value{0, problem.costs()[a]};
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const double singleton = problem.singleton_costs(k)[problem.indices(k)[a]];
    if (singleton == kInfinity) {
      ++value.forced;
    } else {
      value.shifted -= singleton;
    }
  }
  return value;
}

}  // namespace

RankedArcs::RankedArcs(const Problem& problem) {
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    const Value value = value_of(problem, a);
    if (value < Value{}) arcs_.push_back({value, static_cast<std::uint32_t>(a)});
  }
  std::sort(arcs_.begin(), arcs_.end(), [](const Entry& x, const Entry& y) {
    if (x.value < y.value) return true;
    return y.value < x.value ? false : x.arc < y.arc;
  });
  std::vector<std::uint32_t> first;
  for (const Index size : problem.sizes()) {
    first.push_back(static_cast<std::uint32_t>(num_slots_));
    num_slots_ += size;
  }
  start_.reserve(arcs_.size() + 1);
  for (const Entry& entry : arcs_) {
    start_.push_back(slots_.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
      const Index i = problem.indices(static_cast<int>(k))[entry.arc];
      if (i != 0) slots_.push_back(first[k] + i - 1);
    }
  }
  start_.push_back(slots_.size());
}

void complete_greedily(const RankedArcs& ranked, Cover& cover, std::vector<std::size_t>& chosen) {
  for (std::size_t rank = 0; rank < ranked.size(); ++rank) {
    if (!cover.is_free(ranked.slots(rank))) continue;
    cover.add(ranked.slots(rank));
    chosen.push_back(rank);
  }
}

Value total_value(const RankedArcs& ranked, std::span<const std::size_t> chosen) {
  Value total;
  for (const std::size_t rank : chosen) total += ranked.value(rank);
  return total;
}

long double cost_alone(UseBounds bounds, double singleton, Index used) {
  if (used > bounds.hi) return kInfinity;
  if (singleton < 0) return static_cast<long double>(bounds.hi - used) * singleton;
  if (used >= bounds.lo) return 0;
  return static_cast<long double>(bounds.lo - used) * singleton;
}

BaselineResult make_result(const Problem& problem, std::vector<std::uint32_t> arcs) {
  std::sort(arcs.begin(), arcs.end());
  BaselineResult result;
  long double cost = 0;
  for (const std::uint32_t a : arcs) {
    cost += problem.costs()[a];
    result.arcs.push_back(problem.arc(a));
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    std::vector<Index> used(problem.size(k) + std::size_t{1}, 0);
    for (const std::uint32_t a : arcs) ++used[problem.indices(k)[a]];
    for (Index i = 1; i <= problem.size(k); ++i)
      cost += cost_alone(problem.use_bounds(k, i), problem.singleton_costs(k)[i], used[i]);
  }
  result.cost = static_cast<double>(cost);
  result.feasible = result.cost < kInfinity;
  return result;
}

BaselineResult make_result(const Problem& problem,
                           const RankedArcs& ranked,
                           std::span<const std::size_t> chosen) {
  std::vector<std::uint32_t> arcs;
  for (const std::size_t rank : chosen) arcs.push_back(ranked.arc(rank));
  return make_result(problem, std::move(arcs));
}

}  // namespace nda::baselines
