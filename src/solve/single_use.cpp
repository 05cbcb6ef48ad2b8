#include "solve/single_use.hpp"

#include "core/fault_text.hpp"

namespace nda::pipeline {

void require_single_use(const Problem& problem, const std::string& what) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (problem.use_bounds(k, i) == UseBounds{}) continue;
      throw InputError(what + " needs that every index is to be used once, and " +
                       core::index_text(static_cast<std::size_t>(k), i) + " has other bounds");
    }
  }
}

}  // namespace nda::pipeline
