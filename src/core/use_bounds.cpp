#include "core/use_bounds.hpp"

#include "core/fault_text.hpp"

namespace nda::core {

std::string bounds_text(UseBounds bounds) {
  const std::string hi = bounds.hi == UseBounds::kUnlimited ? "inf" : std::to_string(bounds.hi);
  return std::to_string(bounds.lo) + ".." + hi;
}

std::string first_bounds(const Problem& problem) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto bounds = problem.use_bounds(k);
    for (std::size_t i = 1; i < bounds.size(); ++i) {
      if (bounds[i] == UseBounds{}) continue;
      return index_text(static_cast<std::size_t>(k), i) + " has bounds " + bounds_text(bounds[i]);
    }
  }
  return {};
}

void require_single_uses(const Problem& problem, const std::string& who) {
  if (!problem.is_many_to_one()) return;
  throw InputError(who + " cannot deal with bounds on uses: " + first_bounds(problem));
}

}  // namespace nda::core
