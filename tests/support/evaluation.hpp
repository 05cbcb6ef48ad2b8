#pragma once

#include <span>
#include <vector>

namespace nda::support {

/// What a dual function is at some multipliers.
struct Evaluation {
  double value;
  std::vector<double> subgradient;
};

/// At multipliers by slot; those of kept dimensions are ignored.
template <typename RelaxedDual>
Evaluation evaluate(RelaxedDual& function, std::span<const double> u) {
  Evaluation result;
  result.subgradient.resize(function.num_variables());
  result.value = function.evaluate(u.subspan(function.first_slot()), result.subgradient);
  return result;
}

}  // namespace nda::support
