#pragma once

#include <cstddef>
#include <vector>

#include "core/part_proof.hpp"

namespace nda::core {

/// Costs and bounds of more steps of a grid than this are no matter of a grid.
inline constexpr double kMostGridSteps = 0x1p50;

/// Costs of a part are multiples of a grid, but for the rounding of their terms.
class ProofGrid {
 public:
  /// @param step        all costs below are multiples of it but for one rounding; 0 = not known.
  /// @param singletons  +inf = forbidden, no cost.
  ProofGrid(double step, const PartArcs& arcs, const std::vector<double>& singletons);

  /// What is no more than `bound` rounded up to a multiple, less what rounding may have done to
  /// the costs of at most so many indices, and no less than `bound`.
  double rounded_up(double bound, std::size_t num_indices) const;

 private:
  double step_;
  double largest_ = 0;  // cost, in size
  bool exact_ = true;   // costs are multiples without any rounding
};

}  // namespace nda::core
