#include "support/matchers.hpp"

#include <map>
#include <set>
#include <utility>

namespace nda::support {
namespace {

std::string name_of(int k, Index i) {
  return "index " + std::to_string(i) + " of dimension " + std::to_string(k + 1);
}

using Uses = std::map<std::pair<int, Index>, Index>;

// How many tuples use each pair (dimension, index).
Uses uses_of(const Tuples& arcs) {
  Uses uses;
  for (const std::vector<Index>& tuple : arcs) {
    for (int k = 0; k < static_cast<int>(tuple.size()); ++k) {
      const Index i = tuple[static_cast<std::size_t>(k)];
      if (i != 0) ++uses[{k, i}];
    }
  }
  return uses;
}

}  // namespace

std::string infeasibility(const Problem& problem, const Tuples& arcs) {
  for (const std::vector<Index>& tuple : arcs) {
    if (!problem.find(tuple)) return ::testing::PrintToString(tuple) + " is no arc of the problem";
  }
  if (std::set(arcs.begin(), arcs.end()).size() < arcs.size()) return "an arc is chosen twice";
  Uses uses = uses_of(arcs);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      const UseBounds bounds = problem.use_bounds(k, i);
      const Index used = uses[{k, i}];
      if (used > bounds.hi) return name_of(k, i) + " is used too often";
      if (used < bounds.lo && problem.singleton_costs(k)[i] == kInfinity)
        return name_of(k, i) + " is used too rarely";
    }
  }
  return {};
}

double cost_of(const Problem& problem, const Tuples& arcs) {
  long double cost = 0;
  for (const std::vector<Index>& tuple : arcs) {
    const auto a = problem.find(tuple);
    if (!a) return kInfinity;
    cost += problem.costs()[*a];
  }
  Uses uses = uses_of(arcs);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      const UseBounds bounds = problem.use_bounds(k, i);
      const long double singleton = problem.singleton_costs(k)[i];
      // One after the other, until enough and as long as it pays.
      for (Index used = uses[{k, i}]; used < bounds.lo || (singleton < 0 && used < bounds.hi);
           ++used)
        cost += singleton;
    }
  }
  return static_cast<double>(cost);
}

}  // namespace nda::support
