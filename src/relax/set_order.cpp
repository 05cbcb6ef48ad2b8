#include "relax/set_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/permuted.hpp"

// Whatever is kept, two sets give the same best bound; what differs is how many multipliers there
// are, how soon they are good, and what alignments look like.  With three kept sets and more the
// bound itself depends on the choice.

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;
using Order = std::vector<std::size_t>;

constexpr std::size_t kMostProbes = 20;
constexpr int kProbeEvaluations = 10;

Order as_given(const Component& component) {
  Order order(component.sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

// By falling key.
Order sorted_by(const std::vector<double>& key, Order order) {
  std::stable_sort(
      order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key[a] > key[b]; });
  return order;
}

// Pairs of arcs that share an index of the dimension, of those that cost less than nothing.
double conflicts(const Component& component, std::size_t k) {
  std::vector<double> arcs_of(component.sizes[k] + std::size_t{1}, 0.0);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (component.costs[a] < 0) ++arcs_of[component.indices[k][a]];
  }
  double pairs = 0;
  for (std::size_t i = 1; i < arcs_of.size(); ++i) pairs += arcs_of[i] * (arcs_of[i] - 1) / 2;
  return pairs;
}

Order with_first(const Component& component, const Order& first) {
  Order order = first;
  for (const std::size_t k : as_given(component)) {
    if (std::find(first.begin(), first.end(), k) == first.end()) order.push_back(k);
  }
  return order;
}

// Appends all choices of `left` more dimensions from `next` on, until there are too many.
void choose(std::size_t next,
            std::size_t end,
            std::size_t left,
            Order& chosen,
            std::vector<Order>& choices) {
  if (choices.size() > kMostProbes) return;
  if (left == 0) return choices.push_back(chosen);
  for (std::size_t k = next; k + left <= end; ++k) {
    chosen.push_back(k);
    choose(k + 1, end, left - 1, chosen, choices);
    chosen.pop_back();
  }
}

std::vector<Order> choices_of(const Component& component, std::size_t num_kept) {
  std::vector<Order> choices;
  Order chosen;
  choose(0, component.sizes.size(), num_kept, chosen, choices);
  if (choices.size() <= kMostProbes) return choices;
  choices.clear();
  for (const std::size_t k : as_given(component)) choices.push_back({k});
  return choices;
}

Order best_probe(const Component& component, const LagrangianOptions& loop) {
  LagrangianOptions probe = loop;
  probe.max_evaluations = std::min(loop.max_evaluations, kProbeEvaluations);
  probe.recovery_interval = 0;
  probe.certify = true;
  probe.settle = {};
  const std::size_t num_kept =
      std::min(static_cast<std::size_t>(loop.kept.num_kept), component.sizes.size() - 1);
  std::pair<double, Order> best{-kInfinity, as_given(component)};
  for (const Order& choice : choices_of(component, num_kept)) {
    const Order order = with_first(component, choice);
    const core::Permuted permuted(component, order);
    const LagrangianResult result = maximize_dual(permuted.component(), {}, probe, {});
    const double bound = std::max(result.lower, result.kept_bound);
    if (bound > best.first) best = {bound, order};
  }
  return best.second;
}

}  // namespace

std::vector<std::size_t> set_order(const Component& component,
                                   SetOrder rule,
                                   const LagrangianOptions& loop) {
  std::vector<double> key(component.sizes.size());
  switch (rule) {
    case SetOrder::kAsGiven:
      break;
    case SetOrder::kLargestFirst:
      std::copy(component.sizes.begin(), component.sizes.end(), key.begin());
      break;
    case SetOrder::kMostConflictingFirst:
      for (std::size_t k = 0; k < key.size(); ++k) key[k] = conflicts(component, k);
      break;
    case SetOrder::kProbe:
      return best_probe(component, loop);
  }
  return sorted_by(key, as_given(component));
}

}  // namespace nda::relax
