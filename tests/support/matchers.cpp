#include "support/matchers.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace nda::support {
namespace {

std::string name_of(int k, Index i) {
  return "index " + std::to_string(i) + " of dimension " + std::to_string(k + 1);
}

// Pairs (dimension, index) used by the tuples; faults are appended to `fault`.
std::set<std::pair<int, Index>> used_by(const Tuples& arcs, std::string& fault) {
  std::set<std::pair<int, Index>> used;
  for (const std::vector<Index>& tuple : arcs) {
    for (int k = 0; k < static_cast<int>(tuple.size()); ++k) {
      const Index i = tuple[static_cast<std::size_t>(k)];
      if (i != 0 && !used.insert({k, i}).second) fault = name_of(k, i) + " is used twice";
    }
  }
  return used;
}

}  // namespace

std::string infeasibility(const Problem& problem, const Tuples& arcs) {
  for (const std::vector<Index>& tuple : arcs) {
    if (!problem.find(tuple)) return ::testing::PrintToString(tuple) + " is no arc of the problem";
  }
  std::string fault;
  const auto used = used_by(arcs, fault);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (used.count({k, i}) == 0 && problem.singleton_costs(k)[i] == kInfinity) {
        fault = name_of(k, i) + " is uncovered and must not be";
      }
    }
  }
  return fault;
}

double cost_of(const Problem& problem, const Tuples& arcs) {
  long double cost = 0;
  for (const std::vector<Index>& tuple : arcs) {
    const auto a = problem.find(tuple);
    if (!a) return kInfinity;
    cost += problem.costs()[*a];
  }
  std::string ignored;
  const auto used = used_by(arcs, ignored);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (used.count({k, i}) == 0) cost += problem.singleton_costs(k)[i];
    }
  }
  return static_cast<double>(cost);
}

}  // namespace nda::support
