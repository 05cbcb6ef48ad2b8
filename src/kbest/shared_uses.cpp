#include "kbest/shared_uses.hpp"

#include <algorithm>
#include <set>

// By the definition, solution by solution: shared indices are few, and only two of them can meet in
// two arcs of one solution.

namespace nda::kbest {
namespace {

using core::DoubleDouble;
using Tuple = std::vector<Index>;

std::size_t position_of(const Tuple& tuple, std::span<const ArcMarginal> arcs) {
  const auto found = std::lower_bound(
      arcs.begin(), arcs.end(), tuple, [](const ArcMarginal& arc, const Tuple& sought) {
        return arc.arc < sought;
      });
  return static_cast<std::size_t>(found - arcs.begin());
}

}  // namespace

SharedUses::SharedUses(const IndexNumbers& numbers,
                       const std::vector<bool>& shared,
                       std::span<const RankedSolution> ranks,
                       std::span<const double> weights,
                       std::span<const ArcMarginal> arcs) {
  std::map<std::size_t, Use> none;
  for (std::size_t index = 0; index < shared.size(); ++index) {
    if (shared[index]) none[index] = {};
  }
  if (none.empty()) return;
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    std::map<std::size_t, Use> uses = none;
    for (const Tuple& tuple : ranks[r].arcs) {
      numbers.for_each(tuple, [&](std::size_t index) {
        if (shared[index]) uses[index].push_back(position_of(tuple, arcs));
      });
    }
    for (const auto& [index, use] : uses) uses_[index][use].add(weights[r]);
    add_pairs(numbers, uses, arcs, weights[r]);
  }
}

// Of every arc but the first that has both indices.
void SharedUses::add_pairs(const IndexNumbers& numbers,
                           const std::map<std::size_t, Use>& uses,
                           std::span<const ArcMarginal> arcs,
                           double weight) {
  for (const auto& [first, use] : uses) {
    if (use.size() < 2) continue;
    std::set<std::size_t> met;
    for (const std::size_t a : use) {
      numbers.for_each(arcs[a].arc, [&, first = first](std::size_t second) {
        if (second > first && !met.insert(second).second) excess_[{first, second}].add(weight);
      });
    }
  }
}

double SharedUses::alone(std::size_t index) const {
  const std::map<Use, DoubleDouble>& uses = uses_.at(index);
  const auto found = uses.find({});
  return found == uses.end() ? 0 : std::min(found->second.high(), 1.0);
}

std::vector<double> SharedUses::weights(std::size_t index) const {
  std::vector<double> weights;
  for (const auto& [use, weight] : uses_.at(index)) weights.push_back(weight.high());
  return weights;
}

DoubleDouble SharedUses::excess(std::size_t first, std::size_t second) const {
  const auto found = excess_.find({first, second});
  return found == excess_.end() ? DoubleDouble() : found->second;
}

}  // namespace nda::kbest
