#pragma once

namespace nda::core {

/// std::min and std::max by value: of references they become jumps, which are hard to foresee in a
/// pass over arcs.  a where both are equal or one is NaN.
inline double min_of(double a, double b) {
  return b < a ? b : a;
}
inline double max_of(double a, double b) {
  return a < b ? b : a;
}

}  // namespace nda::core
