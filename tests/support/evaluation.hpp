#pragma once

#include <gtest/gtest.h>

#include <cstddef>
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

/// Definition 4.2 and (4.4) at two points: the plane of a subgradient at the one is nowhere below
/// the function at the other, and half-way the function is not below the mean.
template <typename RelaxedDual>
void expect_concave(RelaxedDual& function,
                    std::span<const double> u,
                    std::span<const double> w,
                    double tie) {
  const Evaluation at_u = evaluate(function, u);
  const Evaluation at_w = evaluate(function, w);
  double plane = at_u.value;
  std::vector<double> middle(u.size());
  for (std::size_t slot = 0; slot < u.size(); ++slot) {
    middle[slot] = (u[slot] + w[slot]) / 2;
    if (slot < function.first_slot()) continue;
    plane += at_u.subgradient[slot - function.first_slot()] * (w[slot] - u[slot]);
  }
  EXPECT_LE(at_w.value, plane + tie);
  EXPECT_GE(evaluate(function, middle).value, (at_u.value + at_w.value) / 2 - tie);
}

}  // namespace nda::support
