#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "nda/problem.hpp"

namespace nda::support {

using Tuple = std::vector<Index>;
using Change = std::function<void(Tuple&, double&)>;

/// All arcs and singletons of a problem, changed one by one, as a new problem.
inline Problem rebuilt(const Problem& problem, std::vector<Index> sizes, const Change& change) {
  ProblemBuilder builder(std::move(sizes));
  const auto add = [&](Tuple tuple, double cost) {
    change(tuple, cost);
    builder.add_arc(tuple, cost);
  };
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) add(problem.arc(a), problem.costs()[a]);
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      Tuple tuple(problem.sizes().size(), 0);
      tuple[static_cast<std::size_t>(k)] = i;
      add(std::move(tuple), problem.singleton_costs(k)[i]);
    }
  }
  return std::move(builder).build();
}

inline std::vector<Index> sizes_of(const Problem& problem) {
  return {problem.sizes().begin(), problem.sizes().end()};
}

}  // namespace nda::support
