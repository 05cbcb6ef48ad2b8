#include "kbest/slack_view.hpp"

#include <algorithm>

#include "core/double_double.hpp"

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

void SlackView::reduce_costs(const Solution& solution) {
  reduced_.resize(problem_.num_arcs());
  for (ArcId a = 0; a < reduced_.size(); ++a) {
    core::DoubleDouble r(problem_.costs()[a]);
    for (std::size_t k = 0; k < offset_.size(); ++k) {
      const Index i = problem_.indices(static_cast<int>(k))[a];
      if (i != 0) r.add(-solution.multipliers[k][i - 1]);
    }
    reduced_[a] = std::max(0.0, r.high());
  }
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
  std::vector<std::size_t> slots;
  for_each_slot(a, [&](std::size_t s) { slots.push_back(s); });
  if (owner_[slots.front()] == a) return removal(a, {});
  double rise = reduced_[a];
  for (const std::size_t s : slots) rise -= owner_[s] == kNone ? price_[s] : 0;
  for (const ArcId b : excluders(a)) rise += removal(b, slots);
  return rise;
}

// What it costs to take an arc of the best solution out and lay its indices bare, but for `kept`.
double SlackView::removal(ArcId b, std::span<const std::size_t> kept) const {
  double rise = -reduced_[b];
  for_each_slot(b, [&](std::size_t s) {
    if (std::find(kept.begin(), kept.end(), s) == kept.end()) rise += price_[s];
  });
  return rise;
}

// The arcs of the best solution that share an index with an arc.
std::vector<ArcId> SlackView::excluders(ArcId a) const {
  std::vector<ArcId> found;
  for_each_slot(a, [&](std::size_t s) {
    const ArcId owner = owner_[s];
    if (owner != kNone && std::find(found.begin(), found.end(), owner) == found.end())
      found.push_back(owner);
  });
  return found;
}

std::vector<ArcId> SlackView::arcs_of(const Neighbour& neighbour) const {
  const std::vector<ArcId> out = excluders(neighbour.arc);
  std::vector<ArcId> arcs;
  std::copy_if(best_.begin(), best_.end(), std::back_inserter(arcs), [&](ArcId a) {
    return std::find(out.begin(), out.end(), a) == out.end();
  });
  const bool was_in = out.size() == 1 && out.front() == neighbour.arc;
  if (!was_in) arcs.push_back(neighbour.arc);
  return arcs;
}

RankedSolution SlackView::solution_of(std::vector<ArcId> arcs) const {
  std::sort(arcs.begin(), arcs.end());
  RankedSolution solution;
  core::DoubleDouble cost;
  std::vector<bool> covered(price_.size(), false);
  for (const ArcId a : arcs) {
    cost.add(problem_.costs()[a]);
    solution.arcs.push_back(problem_.arc(a));
    for_each_slot(a, [&](std::size_t s) { covered[s] = true; });
  }
  for (int k = 0; k < problem_.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem_.size(k); ++i) {
      if (!covered[slot(static_cast<std::size_t>(k), i)]) cost.add(problem_.singleton_costs(k)[i]);
    }
  }
  solution.cost = cost.high();
  return solution;
}

}  // namespace nda::kbest
