#include "kbest/slack_view.hpp"

#include <algorithm>
#include <utility>

#include "core/shift.hpp"
#include "core/slices.hpp"
#include "solve/solutions.hpp"

namespace nda::kbest {

using core::ArcId;

namespace {

constexpr std::size_t kPairsPerWanted = 32;

}  // namespace

SlackView::SlackView(const Problem& problem,
                     const Solution& solution,
                     const core::Deadline& deadline)
    : problem_(problem) {
  price_indices(solution);
  reduce_costs(deadline);
  take(solution.solutions.front());
}

void SlackView::price_indices(const Solution& solution) {
  for (int k = 0; k < problem_.num_dimensions(); ++k) {
    const std::vector<double>& u = solution.multipliers[static_cast<std::size_t>(k)];
    offset_.push_back(price_.size());
    multipliers_.offset.push_back(static_cast<std::uint32_t>(price_.size()));
    multipliers_.charged.push_back(k);
    multipliers_.base.push_back({0});
    multipliers_.base.back().insert(multipliers_.base.back().end(), u.begin(), u.end());
    price_.push_back(0);
    for (Index i = 1; i <= problem_.size(k); ++i)
      price_.push_back(std::max(0.0, problem_.singleton_costs(k)[i] - u[i - 1]));
  }
}

void SlackView::reduce_costs(const core::Deadline& deadline) {
  reduced_.resize(problem_.num_arcs());
  core::for_each_until(deadline, reduced_.size(), [&](std::size_t a) {
    reduced_[a] = std::max(0.0, core::shifted_cost(problem_, multipliers_, a));
  });
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

std::vector<SlackView::Neighbour> SlackView::neighbours(std::size_t wanted,
                                                        const core::Deadline& deadline) const {
  std::vector<Neighbour> found;
  core::for_each_until(deadline, reduced_.size(), [&](std::size_t n) {
    const auto a = static_cast<ArcId>(n);
    const double cost = rise(a);
    if (cost < kInfinity) found.push_back({cost, a});
  });
  add_pairs(wanted, deadline, found);
  return found;
}

// Only such as may be among the cheapest.
void SlackView::add_pairs(std::size_t wanted,
                          const core::Deadline& deadline,
                          std::vector<Neighbour>& found) const {
  double most = kInfinity;
  if (wanted <= found.size()) {
    const auto last = found.begin() + static_cast<std::ptrdiff_t>(wanted) - 1;
    std::nth_element(found.begin(), last, found.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.rise < b.rise;
    });
    most = last->rise;
  }
  std::vector<ArcId> firsts;
  core::for_each_until(deadline, reduced_.size(), [&](std::size_t n) {
    const auto a = static_cast<ArcId>(n);
    if (reduced_[a] < most + slack_ && !is_best(a)) firsts.push_back(a);
  });
  const std::size_t tried = std::min(kPairsPerWanted * wanted, firsts.size());
  std::nth_element(firsts.begin(),
                   firsts.begin() + static_cast<std::ptrdiff_t>(tried),
                   firsts.end(),
                   [&](ArcId a, ArcId b) {
                     return reduced_[a] != reduced_[b] ? reduced_[a] < reduced_[b] : a < b;
                   });
  std::vector<Neighbour> pairs;
  core::for_each_until(deadline, tried, [&](std::size_t n) {
    const std::optional<Neighbour> pair = complete(firsts[n]);
    if (pair && pair->rise < most) pairs.push_back(*pair);
  });
  // Each may complete the other.
  const auto arcs = [](const Neighbour& pair) { return std::pair(pair.arc, pair.second); };
  std::sort(pairs.begin(), pairs.end(), [&](const Neighbour& a, const Neighbour& b) {
    return arcs(a) < arcs(b);
  });
  const auto same = [&](const Neighbour& a, const Neighbour& b) { return arcs(a) == arcs(b); };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  found.insert(found.end(), pairs.begin(), pairs.end());
}

// With the arc, if there is one, that covers all that an arc lays bare.
std::optional<SlackView::Neighbour> SlackView::complete(ArcId a) const {
  const std::vector<Index> rest = laid_bare(a);
  if (rest.empty()) return std::nullopt;
  const std::optional<std::size_t> other = problem_.find(rest);
  if (!other) return std::nullopt;
  const auto c = static_cast<ArcId>(*other);
  if (is_best(c)) return std::nullopt;
  double rise = reduced_[a] + reduced_[c];
  for_each_slot(a, [&](std::size_t s) { rise -= owner_[s] == kNone ? price_[s] : 0; });
  for_each_excluder(a, [&](ArcId b) { rise -= reduced_[b]; });
  return Neighbour{rise, std::min(a, c), std::max(a, c)};
}

// A tuple of the indices of those that exclude an arc, but for its own; empty where two are of one
// dimension.
std::vector<Index> SlackView::laid_bare(ArcId a) const {
  std::vector<Index> rest(offset_.size(), 0);
  bool is_tuple = true;
  for_each_excluder(a, [&](ArcId b) {
    for_each_index(b, [&](std::size_t k, Index i) {
      if (index(k, a) == i) return;
      is_tuple = is_tuple && rest[k] == 0;
      rest[k] = i;
    });
  });
  return is_tuple ? rest : std::vector<Index>{};
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
  for (const ArcId next : {neighbour.arc, neighbour.second}) {
    if (next == kNone) continue;
    for_each_excluder(next, [&](ArcId b) { std::erase(arcs, b); });
    if (!is_best(next)) arcs.push_back(next);
  }
  return arcs;
}

RankedSolution SlackView::solution_of(std::vector<ArcId> arcs) const {
  std::sort(arcs.begin(), arcs.end());
  return pipeline::make_solution(problem_, arcs, pipeline::coverage(problem_, arcs));
}

}  // namespace nda::kbest
