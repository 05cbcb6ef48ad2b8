#include "nda/marginals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/double_double.hpp"
#include "kbest/index_numbers.hpp"
#include "kbest/ranks.hpp"
#include "kbest/shared_uses.hpp"
#include "nda/solution.hpp"

// Sums of weights over a list of solutions, which mostly agree: a rank is compared with the first
// one of greatest weight, the base, by a walk along both lists of arcs, and only where they differ
// is anything added.
//
//   arc that the base lacks    sum of the weights of the ranks that have it
//   arc of the base            total - sum of the weights of the ranks that lack it
//   index the base covers      alone: sum over the ranks that drop its arc and put none in its
//   place index the base leaves      alone: total - sum over the ranks that cover it
//
// The base weighs at least 1/k, so no difference above loses digits that matter.  Sums are kept in
// double-double, hence those of one index add up to 1 but for the last rounding of each, whatever
// the number of ranks.
//
// A pair's weight is the sum over the arcs that hold both: these exclude each other.  Neither that
// nor the two lines on indices is so where bounds on uses let a rank have several arcs of an index;
// kbest/shared_uses.hpp goes through the ranks for these.

namespace nda {
namespace {

using core::DoubleDouble;
using kbest::IndexNumbers;
using Tuple = std::vector<Index>;

double rounded(const DoubleDouble& sum) {
  return std::clamp(sum.high(), 0.0, 1.0);
}

// What is left of the total; exactly 1 where nothing was taken from it.
double rest_of(DoubleDouble total, const DoubleDouble& part) {
  if (part.high() == 0) return 1;
  total.add(-part.high());
  total.add(-part.low());
  return rounded(total);
}

[[noreturn]] void fail(std::size_t rank, const std::string& what) {
  throw InputError("number " + std::to_string(rank + 1) + " of the solutions " + what);
}

void require_tuple(std::span<const Index> sizes, std::size_t rank, const Tuple& tuple) {
  if (tuple.size() != sizes.size()) {
    fail(rank,
         "has an arc of " + std::to_string(tuple.size()) + " indices, not " +
             std::to_string(sizes.size()));
  }
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    if (tuple[k] <= sizes[k]) continue;
    fail(rank,
         "uses index " + std::to_string(tuple[k]) + " of dimension " + std::to_string(k + 1) +
             ", which has " + std::to_string(sizes[k]));
  }
}

// Returns by index number whether a rank uses the index in several arcs.
std::vector<bool> require_solutions(std::span<const Index> sizes,
                                    std::span<const RankedSolution> ranks) {
  const IndexNumbers numbers(sizes);
  std::vector<std::size_t> used_by(numbers.count(), ranks.size());
  std::vector<bool> shared(numbers.count());
  for (std::size_t r = 0; r < ranks.size(); ++r) {
    if (std::isnan(ranks[r].cost)) fail(r, "has a cost that is not a number");
    const std::vector<Tuple>& arcs = ranks[r].arcs;
    for (const Tuple& tuple : arcs) {
      require_tuple(sizes, r, tuple);
      numbers.for_each(tuple, [&](std::size_t index) {
        if (std::exchange(used_by[index], r) == r) shared[index] = true;
      });
    }
    if (!std::is_sorted(arcs.begin(), arcs.end())) fail(r, "has arcs that are not in order");
    if (std::adjacent_find(arcs.begin(), arcs.end()) != arcs.end()) fail(r, "has an arc twice");
  }
  return shared;
}

// exp(-(cost - least) / cost_per_nat), to the sum 1.
std::vector<double> weights_of(std::span<const RankedSolution> ranks, double cost_per_nat) {
  double least = kInfinity;
  for (const RankedSolution& rank : ranks) least = std::min(least, rank.cost);
  std::vector<double> weights;
  DoubleDouble sum;
  for (const RankedSolution& rank : ranks) {
    const bool is_least = rank.cost == least;  // maybe both infinite
    weights.push_back(is_least ? 1 : std::exp((least - rank.cost) / cost_per_nat));
    sum.add(weights.back());
  }
  for (double& weight : weights) weight /= sum.high();
  return weights;
}

// -sum w ln w.  The greatest w may be too near 1 for its own logarithm, so it comes from the
// others.
double entropy_of(std::vector<double> weights) {
  std::sort(weights.begin(), weights.end());
  double others = 0;
  double entropy = 0;
  for (const double weight : std::span(weights).first(weights.size() - 1)) {
    others += weight;
    if (weight > 0) entropy -= weight * std::log(weight);
  }
  if (others < 1) entropy -= weights.back() * std::log1p(-others);
  return entropy;
}

class Summation {
 public:
  Summation(std::span<const Index> sizes,
            std::span<const RankedSolution> ranks,
            std::span<const double> weights,
            std::vector<bool> shared)
      : numbers_(sizes),
        ranks_(ranks),
        weights_(weights),
        shared_(std::move(shared)),
        base_(ranks[heaviest(weights)].arcs),
        missing_(base_.size()),
        marks_(numbers_.count()) {
    for (const Tuple& tuple : base_) {
      numbers_.for_each(tuple, [&](std::size_t index) { marks_[index].in_base = true; });
    }
    for (const double weight : weights) total_.add(weight);
    for (std::size_t r = 0; r < ranks.size(); ++r) add(ranks[r], r, weights[r]);
  }

  void finish(std::span<const Index> sizes, Marginals& result) {
    result.arcs = arcs();
    const kbest::SharedUses uses(numbers_, shared_, ranks_, weights_, result.arcs);
    std::vector<std::vector<std::size_t>> arcs_of(numbers_.count());
    for (std::size_t a = 0; a < result.arcs.size(); ++a)
      numbers_.for_each(result.arcs[a].arc, [&](std::size_t i) { arcs_of[i].push_back(a); });
    std::size_t number = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      std::vector<double>& alone = result.alone.emplace_back();
      for (Index i = 1; i <= sizes[k]; ++i, ++number) {
        const bool is_shared = shared_[number];
        alone.push_back(is_shared ? uses.alone(number) : alone_weight(marks_[number]));
        put_pairs(k, i, arcs_of[number], uses, result);
        if (!marks_[number].is_ambiguous) continue;
        put_ambiguous(k, i, std::move(arcs_of[number]), alone.back(), result);
        if (is_shared) result.ambiguous.back().entropy = entropy_of(uses.weights(number));
      }
    }
    std::stable_sort(result.ambiguous.begin(), result.ambiguous.end(), more_ambiguous);
  }

 private:
  struct Mark {
    std::size_t used_by = 0;  // rank + 1 of the last that has an arc of it which the base lacks
    bool in_base = false;     // the base covers it
    bool is_ambiguous = false;
    DoubleDouble other;  // weight of the ranks that leave it alone where the base covers it, and
                         // cover it where the base does not
  };

  struct Hash {
    std::size_t operator()(const Tuple* tuple) const {
      std::uint64_t hash = 0;
      for (const Index i : *tuple) {
        hash = (hash ^ i) * 0x9E3779B97F4A7C15;
        hash ^= hash >> 29;
      }
      return hash;
    }
  };

  struct Equal {
    bool operator()(const Tuple* a, const Tuple* b) const { return *a == *b; }
  };

  static std::size_t heaviest(std::span<const double> weights) {
    const auto found = std::max_element(weights.begin(), weights.end());
    return static_cast<std::size_t>(found - weights.begin());
  }

  static bool more_ambiguous(const AmbiguousIndex& a, const AmbiguousIndex& b) {
    return a.entropy > b.entropy;
  }

  double alone_weight(const Mark& mark) const {
    return mark.in_base ? rounded(mark.other) : rest_of(total_, mark.other);
  }

  void add(const RankedSolution& rank, std::size_t r, double weight) {
    std::vector<std::size_t> dropped;  // positions in the base
    auto ours = rank.arcs.begin();
    for (std::size_t b = 0; b < base_.size() || ours != rank.arcs.end();) {
      const bool both = b < base_.size() && ours != rank.arcs.end();
      if (both && *ours == base_[b]) {
        ++ours;
        ++b;
      } else if (both ? *ours < base_[b] : b == base_.size()) {
        add_arc(*ours++, r, weight);
      } else {
        dropped.push_back(b++);
      }
    }
    for (const std::size_t b : dropped) drop_arc(b, r, weight);
  }

  void add_arc(const Tuple& tuple, std::size_t r, double weight) {
    additions_[&tuple].add(weight);
    numbers_.for_each(tuple, [&](std::size_t index) {
      Mark& mark = marks_[index];
      mark.used_by = r + 1;
      mark.is_ambiguous = true;
      if (!mark.in_base) mark.other.add(weight);
    });
  }

  // After all that the rank adds.
  void drop_arc(std::size_t b, std::size_t r, double weight) {
    missing_[b].add(weight);
    numbers_.for_each(base_[b], [&](std::size_t index) {
      Mark& mark = marks_[index];
      mark.is_ambiguous = true;
      if (mark.used_by != r + 1) mark.other.add(weight);
    });
  }

  std::vector<ArcMarginal> arcs() const {
    std::vector<ArcMarginal> arcs;
    for (std::size_t b = 0; b < base_.size(); ++b)
      arcs.push_back({base_[b], rest_of(total_, missing_[b])});
    for (const auto& [arc, sum] : additions_) arcs.push_back({*arc, rounded(sum)});
    std::sort(arcs.begin(), arcs.end(), [](const ArcMarginal& a, const ArcMarginal& b) {
      return a.arc < b.arc;
    });
    return arcs;
  }

  // The pairs whose first index it is.
  void put_pairs(std::size_t k,
                 Index i,
                 const std::vector<std::size_t>& arcs,
                 const kbest::SharedUses& uses,
                 Marginals& result) const {
    std::vector<PairMarginal> pairs;
    for (const std::size_t a : arcs) {
      const ArcMarginal& marginal = result.arcs[a];
      for (std::size_t other = k + 1; other < marginal.arc.size(); ++other) {
        if (marginal.arc[other] == 0) continue;
        pairs.push_back({static_cast<int>(k),
                         i,
                         static_cast<int>(other),
                         marginal.arc[other],
                         marginal.weight});
      }
    }
    const auto second = [](const PairMarginal& pair) {
      return std::pair(pair.second_dimension, pair.second);
    };
    std::stable_sort(pairs.begin(), pairs.end(), [&](const PairMarginal& a, const PairMarginal& b) {
      return second(a) < second(b);
    });
    for (auto next = pairs.begin(); next != pairs.end();) {
      PairMarginal& pair = result.pairs.emplace_back(*next);
      const DoubleDouble excess = uses.excess(
          numbers_(k, i), numbers_(static_cast<std::size_t>(pair.second_dimension), pair.second));
      DoubleDouble sum(-excess.high());
      sum.add(-excess.low());
      for (; next != pairs.end() && second(*next) == second(pair); ++next) sum.add(next->weight);
      pair.weight = rounded(sum);
    }
  }

  static void put_ambiguous(
      std::size_t k, Index i, std::vector<std::size_t> arcs, double alone, Marginals& result) {
    std::stable_sort(arcs.begin(), arcs.end(), [&](std::size_t a, std::size_t b) {
      return result.arcs[a].weight > result.arcs[b].weight;
    });
    std::vector<double> weights = {alone};
    for (const std::size_t a : arcs) weights.push_back(result.arcs[a].weight);
    result.ambiguous.push_back(
        {static_cast<int>(k), i, entropy_of(std::move(weights)), std::move(arcs)});
  }

  const IndexNumbers numbers_;
  const std::span<const RankedSolution> ranks_;
  const std::span<const double> weights_;
  const std::vector<bool> shared_;  // by index number: several arcs in one rank
  const std::vector<Tuple>& base_;
  DoubleDouble total_;                 // 1, but for rounding
  std::vector<DoubleDouble> missing_;  // of each arc of the base: weight of the ranks without it
  std::vector<Mark> marks_;            // of each index
  std::unordered_map<const Tuple*, DoubleDouble, Hash, Equal> additions_;  // the base lacks them
};

}  // namespace

Marginals marginals(std::span<const Index> sizes,
                    std::span<const RankedSolution> ranks,
                    const MarginalOptions& options) {
  if (!(options.cost_per_nat > 0) || std::isinf(options.cost_per_nat))
    throw InputError("cost_per_nat must be a finite number above 0");
  std::vector<bool> shared = require_solutions(sizes, ranks);
  Marginals result;
  result.cost_per_nat = options.cost_per_nat;
  result.num_proven = kbest::num_proven(ranks);
  if (ranks.empty()) return result;
  result.weights = weights_of(ranks, options.cost_per_nat);
  Summation(sizes, ranks, result.weights, std::move(shared)).finish(sizes, result);
  return result;
}

Marginals marginals(const Solution& solution, const MarginalOptions& options) {
  return marginals(solution.sizes, solution.solutions, options);
}

}  // namespace nda
