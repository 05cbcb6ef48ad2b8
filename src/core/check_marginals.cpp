#include "core/check_marginals.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/fault_text.hpp"

// Marginals by their definition: every rank is gone through with all its arcs and all the indices
// it leaves alone, and sums are kept in long double.  Nothing is shared with kbest/marginals.cpp,
// which looks at differences only.

namespace nda::core {
namespace {

using Tuple = std::vector<Index>;
using Place = std::pair<int, Index>;

struct Sum {
  long double weight = 0;
  std::size_t ranks = 0;
};

// What the solutions do with an index that any of them uses in several arcs.
using SharedUses = std::map<std::set<Tuple>, long double>;

struct Truth {
  std::vector<long double> weights;
  std::map<Tuple, Sum> arcs;
  std::map<std::pair<Place, Place>, long double> pairs;
  std::vector<std::vector<Sum>> alone;  // [k][i-1]
  std::map<Place, SharedUses> shared;
};

std::vector<Place> places_of(const Tuple& tuple) {
  std::vector<Place> places;
  for (std::size_t k = 0; k < tuple.size(); ++k) {
    if (tuple[k] != 0) places.emplace_back(static_cast<int>(k), tuple[k]);
  }
  return places;
}

std::vector<long double> weights_of(const Solution& solution, double cost_per_nat) {
  double least = kInfinity;
  for (const RankedSolution& rank : solution.solutions) least = std::min(least, rank.cost);
  std::vector<long double> weights;
  long double sum = 0;
  for (const RankedSolution& rank : solution.solutions) {
    const long double above = rank.cost == least ? 0 : static_cast<long double>(rank.cost) - least;
    weights.push_back(std::exp(-above / cost_per_nat));
    sum += weights.back();
  }
  for (long double& weight : weights) weight /= sum;
  return weights;
}

void add_rank(const RankedSolution& rank, long double weight, Truth& truth) {
  std::vector<std::vector<bool>> covered;
  for (const std::vector<Sum>& row : truth.alone) covered.emplace_back(row.size(), false);
  for (const Tuple& tuple : rank.arcs) {
    Sum& sum = truth.arcs[tuple];
    sum.weight += weight;
    ++sum.ranks;
    for (std::size_t k = 0; k < tuple.size(); ++k) {
      if (tuple[k] != 0) covered[k][tuple[k] - 1] = true;
    }
  }
  for (std::size_t k = 0; k < covered.size(); ++k) {
    for (std::size_t i = 0; i < covered[k].size(); ++i) {
      if (covered[k][i]) continue;
      truth.alone[k][i].weight += weight;
      ++truth.alone[k][i].ranks;
    }
  }
}

std::vector<Place> shared_places(const Solution& solution) {
  std::set<Place> shared;
  for (const RankedSolution& rank : solution.solutions) {
    std::set<Place> used;
    for (const Tuple& tuple : rank.arcs) {
      for (const Place& place : places_of(tuple)) {
        if (!used.insert(place).second) shared.insert(place);
      }
    }
  }
  return {shared.begin(), shared.end()};
}

// The arcs of a pair were all counted, but the solution has the pair once.
void add_shared(const RankedSolution& rank, long double weight, Truth& truth) {
  std::set<std::pair<Place, Place>> pairs;
  std::map<Place, std::set<Tuple>> used;
  for (const Tuple& tuple : rank.arcs) {
    std::vector<Place> places = places_of(tuple);
    std::erase_if(places, [&](const Place& place) { return !truth.shared.contains(place); });
    for (std::size_t p = 0; p < places.size(); ++p) {
      used[places[p]].insert(tuple);
      for (std::size_t q = p + 1; q < places.size(); ++q) {
        if (!pairs.insert({places[p], places[q]}).second)
          truth.pairs[{places[p], places[q]}] -= weight;
      }
    }
  }
  for (auto& [place, uses] : truth.shared) uses[used[place]] += weight;
}

Truth truth_of(const Solution& solution, double cost_per_nat) {
  Truth truth;
  if (solution.solutions.empty()) return truth;
  truth.weights = weights_of(solution, cost_per_nat);
  for (const Index size : solution.sizes) truth.alone.emplace_back(size);
  for (std::size_t r = 0; r < solution.solutions.size(); ++r)
    add_rank(solution.solutions[r], truth.weights[r], truth);
  for (const auto& [tuple, sum] : truth.arcs) {
    const std::vector<Place> places = places_of(tuple);
    for (std::size_t p = 0; p < places.size(); ++p) {
      for (std::size_t q = p + 1; q < places.size(); ++q)
        truth.pairs[{places[p], places[q]}] += sum.weight;
    }
  }
  for (const Place& place : shared_places(solution)) truth.shared[place] = {};
  if (truth.shared.empty()) return truth;
  for (std::size_t r = 0; r < solution.solutions.size(); ++r)
    add_shared(solution.solutions[r], truth.weights[r], truth);
  return truth;
}

// NaN is not.
bool is_right(double stated, long double right) {
  return std::abs(stated - right) <= 1e-9L * right + 1e-300L;
}

std::string place_text(const Place& place) {
  return index_text(static_cast<std::size_t>(place.first), place.second);
}

std::string instead(const std::string& what, double stated, long double right) {
  return what + " is stated to be " + number_text(stated) + ", the solutions give " +
         number_text(static_cast<double>(right));
}

std::string count_fault(const std::string& what, std::size_t stated, std::size_t right) {
  if (stated == right) return {};
  return std::to_string(stated) + " " + what + " are stated, the solutions give " +
         std::to_string(right);
}

std::string head_fault(const Solution& solution) {
  const Marginals& stated = *solution.marginals;
  if (!(stated.cost_per_nat > 0) || std::isinf(stated.cost_per_nat))
    return "cost_per_nat is " + number_text(stated.cost_per_nat);
  std::size_t proven = 0;
  while (proven < solution.solutions.size() && solution.solutions[proven].proven) ++proven;
  return count_fault("proven ranks", stated.num_proven, proven);
}

std::string weights_fault(const Marginals& stated, const Truth& truth) {
  const std::string fault =
      count_fault("weights of ranks", stated.weights.size(), truth.weights.size());
  if (!fault.empty()) return fault;
  for (std::size_t r = 0; r < truth.weights.size(); ++r) {
    if (!is_right(stated.weights[r], truth.weights[r]))
      return instead(
          "weight of rank " + std::to_string(r + 1), stated.weights[r], truth.weights[r]);
  }
  return {};
}

std::string arcs_fault(const Marginals& stated, const Truth& truth) {
  const std::string fault = count_fault("arcs", stated.arcs.size(), truth.arcs.size());
  if (!fault.empty()) return fault;
  auto next = stated.arcs.begin();
  for (const auto& [tuple, sum] : truth.arcs) {
    if (next->arc != tuple)
      return "arc " + tuple_text(next->arc) + " stands where " + tuple_text(tuple) + " should";
    if (!is_right(next->weight, sum.weight))
      return instead("weight of arc " + tuple_text(tuple), next->weight, sum.weight);
    ++next;
  }
  return {};
}

std::string pairs_fault(const Marginals& stated, const Truth& truth) {
  const std::string fault = count_fault("pairs", stated.pairs.size(), truth.pairs.size());
  if (!fault.empty()) return fault;
  auto next = stated.pairs.begin();
  for (const auto& [pair, weight] : truth.pairs) {
    const std::string name =
        "pair of " + place_text(pair.first) + " and " + place_text(pair.second);
    const Place first = {next->first_dimension, next->first};
    const Place second = {next->second_dimension, next->second};
    if (first != pair.first || second != pair.second)
      return "another pair stands where the " + name + " should";
    if (!is_right(next->weight, weight))
      return instead("weight of the " + name, next->weight, weight);
    ++next;
  }
  return {};
}

std::string alone_fault(const Marginals& stated, const Truth& truth) {
  const std::string fault =
      count_fault("dimensions of `alone`", stated.alone.size(), truth.alone.size());
  if (!fault.empty()) return fault;
  for (std::size_t k = 0; k < truth.alone.size(); ++k) {
    const std::string wrong_size =
        count_fault("weights of `alone` in dimension " + std::to_string(k + 1),
                    stated.alone[k].size(),
                    truth.alone[k].size());
    if (!wrong_size.empty()) return wrong_size;
    for (std::size_t i = 0; i < truth.alone[k].size(); ++i) {
      if (is_right(stated.alone[k][i], truth.alone[k][i].weight)) continue;
      return instead("weight of leaving " + index_text(k, i + 1) + " alone",
                     stated.alone[k][i],
                     truth.alone[k][i].weight);
    }
  }
  return {};
}

// What the solutions do with an index.
struct Uses {
  std::set<Tuple> arcs;
  std::vector<long double> weights;  // of the sets of arcs, the empty one among them
};

// Of the indices with more than one use.
std::map<Place, Uses> ambiguous_uses(const Truth& truth) {
  std::map<Place, Uses> uses;
  for (const auto& [tuple, sum] : truth.arcs) {
    for (const Place& place : places_of(tuple)) {
      uses[place].arcs.insert(tuple);
      uses[place].weights.push_back(sum.weight);
    }
  }
  for (auto& [place, use] : uses) {
    const Sum& alone = truth.alone[static_cast<std::size_t>(place.first)][place.second - 1];
    if (alone.ranks > 0) use.weights.push_back(alone.weight);
  }
  for (const auto& [place, shared] : truth.shared) {
    uses[place].weights.clear();
    for (const auto& [arcs, weight] : shared) uses[place].weights.push_back(weight);
  }
  std::erase_if(uses, [](const auto& entry) { return entry.second.weights.size() < 2; });
  return uses;
}

long double entropy_of(const std::vector<long double>& weights) {
  long double entropy = 0;
  for (const long double weight : weights) entropy -= weight > 0 ? weight * std::log(weight) : 0;
  return entropy;
}

std::string uses_fault(const AmbiguousIndex& stated,
                       const Uses& right,
                       const Marginals& marginals) {
  const std::string name = place_text({stated.dimension, stated.index});
  const long double entropy = entropy_of(right.weights);
  if (!(std::abs(stated.entropy - entropy) <= 1e-9L * entropy + 1e-12L))
    return instead("entropy of " + name, stated.entropy, entropy);
  std::set<Tuple> arcs;
  double weight = 1;
  for (const std::size_t a : stated.arcs) {
    if (a >= marginals.arcs.size()) return name + " has an arc that is not in the list";
    if (marginals.arcs[a].weight > weight) return "the arcs of " + name + " are not in order";
    weight = marginals.arcs[a].weight;
    arcs.insert(marginals.arcs[a].arc);
  }
  if (arcs != right.arcs || stated.arcs.size() != arcs.size())
    return "the arcs of " + name + " are not those of the solutions";
  return {};
}

std::string ambiguous_fault(const Marginals& stated, const Truth& truth) {
  std::map<Place, Uses> uses = ambiguous_uses(truth);
  const std::string fault = count_fault("ambiguous indices", stated.ambiguous.size(), uses.size());
  if (!fault.empty()) return fault;
  std::pair<double, Place> before = {-kInfinity, {}};
  for (const AmbiguousIndex& index : stated.ambiguous) {
    const Place place = {index.dimension, index.index};
    const auto found = uses.find(place);
    if (found == uses.end()) return place_text(place) + " is not ambiguous, or there twice";
    const std::string wrong = uses_fault(index, found->second, stated);
    if (!wrong.empty()) return wrong;
    uses.erase(found);
    const std::pair<double, Place> key = {-index.entropy, place};
    if (key < before) return place_text(place) + " is more ambiguous than the one before";
    before = key;
  }
  return {};
}

}  // namespace

std::string marginals_fault(const Solution& solution) {
  const Marginals& stated = *solution.marginals;
  std::string fault = head_fault(solution);
  if (!fault.empty()) return fault;
  const Truth truth = truth_of(solution, stated.cost_per_nat);
  for (const auto check : {weights_fault, arcs_fault, pairs_fault, alone_fault, ambiguous_fault}) {
    fault = check(stated, truth);
    if (!fault.empty()) break;
  }
  return fault;
}

}  // namespace nda::core
