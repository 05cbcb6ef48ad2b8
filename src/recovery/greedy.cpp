#include "recovery/greedy.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "core/reduced_costs.hpp"
#include "core/slices.hpp"

namespace nda::recovery {

using core::ArcId;

namespace {

// Values below are rounding errors of the linear program.
constexpr double kNothing = 1e-6;

// Sorted with its key beside it: looking it up elsewhere takes longer than the rest.
struct Ranked {
  double key;
  ArcId arc;

  bool operator<(const Ranked& other) const {
    return key != other.key ? key < other.key : arc < other.arc;
  }
};

// Takes what still fits, in this order.
class Taker {
 public:
  explicit Taker(const core::Component& component)
      : component_(component), is_used_(component.num_slots(), 0) {}

  void offer(ArcId a) {
    for (int k = 0; k < component_.num_dimensions(); ++k) {
      if (component_.index(k, a) != 0 && is_used_[component_.slot(k, a)]) return;
    }
    core::for_each_slot(component_, a, [&](std::uint32_t slot) { is_used_[slot] = 1; });
    taken_.push_back(a);
  }

  core::Packing packing() { return core::make_packing(component_, std::move(taken_)); }

 private:
  const core::Component& component_;
  std::vector<char> is_used_;
  std::vector<ArcId> taken_;
};

core::Packing take(const core::Component& component,
                   std::vector<Ranked> ranked,
                   const core::Deadline& deadline) {
  if (!core::sort_until(deadline, ranked, std::less<>())) return {};
  Taker taker(component);
  for (const Ranked& next : ranked) taker.offer(next.arc);
  return taker.packing();
}

}  // namespace

core::Packing greedy(const core::Component& component,
                     std::span<const double> key,
                     const core::Deadline& deadline) {
  std::vector<Ranked> ranked;
  for (ArcId a = 0; a < key.size(); ++a) {
    if (component.costs[a] < 0) ranked.push_back({key[a], a});
  }
  return take(component, std::move(ranked), deadline);
}

core::Packing greedy(const core::Component& component,
                     std::span<const ArcId> arcs,
                     std::span<const double> key) {
  std::vector<Ranked> ranked;
  for (std::size_t n = 0; n < arcs.size(); ++n) {
    if (component.costs[arcs[n]] < 0) ranked.push_back({key[n], arcs[n]});
  }
  return take(component, std::move(ranked), {});
}

core::Packing dual_greedy(const core::Component& component,
                          std::span<const double> u,
                          const core::Deadline& deadline) {
  std::vector<double> key(component.num_arcs());
  core::reduced_costs(component, u, 0, key);
  for (ArcId a = 0; a < key.size(); ++a) key[a] += kTieBreak * component.costs[a];
  return greedy(component, key, deadline);
}

core::Packing round_values(const core::Component& component,
                           std::span<const ArcId> arcs,
                           std::span<const double> values) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    if (values[k] > kNothing) order.push_back(k);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t k, std::size_t l) {
    if (values[k] != values[l]) return values[k] > values[l];
    const double difference = component.costs[arcs[k]] - component.costs[arcs[l]];
    return difference != 0 ? difference < 0 : arcs[k] < arcs[l];
  });
  Taker taker(component);
  for (const std::size_t k : order) taker.offer(arcs[k]);
  return taker.packing();
}

}  // namespace nda::recovery
