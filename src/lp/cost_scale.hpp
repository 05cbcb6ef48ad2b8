#pragma once

#include <algorithm>
#include <cmath>

namespace nda::lp {

// The tolerances of the simplex method suit costs of this size.
inline constexpr double kSmallestCost = 1;
inline constexpr double kLargestCost = 1e5;
// CLP ends the program at costs of 1e25.
inline constexpr int kLargestCostExponent = 66;

/// A power of two that brings costs of this size to one that suits the simplex method; 1 where they
/// have it.
///
/// @param dearest  the largest cost of an arc, without its sign.
/// @param penalty  the largest of the other costs, which may exceed those of arcs by far: they are
/// only kept below what CLP takes.
inline double cost_scale(double dearest, double penalty) {
  constexpr int kScaledExponent = 7;
  constexpr int kLargestExponent = 1000;  // of a scale
  const bool suits = dearest == 0 || (dearest >= kSmallestCost && dearest <= kLargestCost);
  int exponent = suits ? 0 : std::min(kScaledExponent - std::ilogb(dearest), kLargestExponent);
  if (penalty > 0) exponent = std::min(exponent, kLargestCostExponent - std::ilogb(penalty));
  return std::ldexp(1.0, exponent);
}

}  // namespace nda::lp
