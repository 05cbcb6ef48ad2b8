#include "kbest/slack_view.hpp"

#include <algorithm>

#include "core/shift.hpp"
#include "solve/solutions.hpp"

namespace nda::kbest {

using core::ArcId;

SlackView::SlackView(const Problem& problem, const Solution& solution) : problem_(problem) {
  price_indices(solution);
  reduce_costs(solution);
  take(solution.solutions.front());
}

void SlackView::price_indices(const Solution& solution) {
  for (int k = 0; k < problem_.num_dimensions(); ++k) {
    const std::vector<double>& u = solution.multipliers[static_cast<std::size_t>(k)];
    offset_.push_back(price_.size());
    price_.push_back(0);
    for (Index i = 1; i <= problem_.size(k); ++i)
      price_.push_back(std::max(0.0, problem_.singleton_costs(k)[i] - u[i - 1]));
  }
}

// Multipliers charge indices as singletons do.
void SlackView::reduce_costs(const Solution& solution) {
  core::Shift by_multipliers;
  by_multipliers.is_free = false;
  for (const std::vector<double>& u : solution.multipliers) {
    by_multipliers.base.push_back({0});
    by_multipliers.base.back().insert(by_multipliers.base.back().end(), u.begin(), u.end());
  }
  reduced_.resize(problem_.num_arcs());
  for (ArcId a = 0; a < reduced_.size(); ++a)
    reduced_[a] = std::max(0.0, core::shifted_cost(problem_, by_multipliers, a));
}

void SlackView::take(const RankedSolution& best) {
  owner_.assign(price_.size(), kNone);
  for (const std::vector<Index>& tuple : best.arcs) {
    const auto a = static_cast<ArcId>(*problem_.find(tuple));
    best_.push_back(a);
    slack_ += reduced_[a];
    for_each_slot(a, [&](std::size_t s) { owner_[s] = a; });
  }
  for (std::size_t s = 0; s < price_.size(); ++s) {
    if (owner_[s] == kNone) slack_ += price_[s];
  }
}

std::vector<SlackView::Neighbour> SlackView::neighbours(std::size_t most,
                                                        const core::Deadline& deadline) const {
  std::vector<Neighbour> found;
  for (ArcId a = 0; a < reduced_.size() && !deadline.reached(); ++a) {
    const double cost = rise(a);
    if (cost < kInfinity) found.push_back({cost, a});
  }
  const auto cheaper = [](const Neighbour& a, const Neighbour& b) {
    return a.rise != b.rise ? a.rise < b.rise : a.arc < b.arc;
  };
  const auto end = found.begin() + static_cast<std::ptrdiff_t>(std::min(most, found.size()));
  std::partial_sort(found.begin(), end, found.end(), cheaper);
  found.erase(end, found.end());
  return found;
}

double SlackView::rise(ArcId a) const {
  if (is_best(a)) return removal(a, kNone);
  double rise = reduced_[a];
  for_each_slot(a, [&](std::size_t s) { rise -= owner_[s] == kNone ? price_[s] : 0; });
  for_each_excluder(a, [&](ArcId b) { rise += removal(b, a); });
  return rise;
}

// What it costs to take an arc of the best solution out and lay its indices bare, but for those
// that `next` covers.
double SlackView::removal(ArcId b, ArcId next) const {
  double rise = -reduced_[b];
  for_each_index(b, [&](std::size_t k, Index i) {
    if (next == kNone || index(k, next) != i) rise += price_[slot(k, i)];
  });
  return rise;
}

bool SlackView::is_best(ArcId a) const {
  return std::binary_search(best_.begin(), best_.end(), a);
}

std::vector<ArcId> SlackView::arcs_of(const Neighbour& neighbour) const {
  std::vector<ArcId> arcs = best_;
  for_each_excluder(neighbour.arc, [&](ArcId b) { std::erase(arcs, b); });
  if (!is_best(neighbour.arc)) arcs.push_back(neighbour.arc);
  return arcs;
}

RankedSolution SlackView::solution_of(std::vector<ArcId> arcs) const {
  std::sort(arcs.begin(), arcs.end());
  return pipeline::make_solution(problem_, arcs, pipeline::coverage(problem_, arcs));
}

}  // namespace nda::kbest
