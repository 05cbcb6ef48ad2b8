#pragma once

#include <functional>

#include "nda/options.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// What the user is told while solutions are ranked: what solving came to, and the time that goes
/// on.  Nothing where `callback` is empty.
inline std::function<bool(const Progress&)> ranking_progress(
    const Solution& solution, std::function<bool(const Progress&)> callback) {
  if (!callback) return nullptr;
  const std::size_t components = solution.num_components;
  Progress solved = {solution.stats.solve_seconds,
                     solution.cost,
                     solution.lower_bound,
                     components,
                     components,
                     "ranking"};
  return [solved, callback = std::move(callback)](const Progress& now) {
    Progress ranking = solved;
    ranking.seconds += now.seconds;
    return callback(ranking);
  };
}

}  // namespace nda::kbest
