#pragma once

#include <span>
#include <vector>

#include "nda/assign2d.hpp"

namespace nda::lap {

/// A full matrix of costs with outside options; +inf forbids a pair.
struct DenseProblem {
  std::span<const double> cost;  ///< row by row
  std::span<const double> row_outside;
  std::span<const double> column_outside;

  std::uint32_t num_rows() const { return static_cast<std::uint32_t>(row_outside.size()); }
  std::uint32_t num_columns() const { return static_cast<std::uint32_t>(column_outside.size()); }
  const double* line(std::uint32_t i) const { return cost.data() + i * column_outside.size(); }
};

/// A problem as a full matrix: the stored costs themselves if all pairs are stored, else a copy
/// with +inf.
class FullMatrix {
 public:
  /// Valid until the next call and while `problem` lives.
  DenseProblem of(const Assign2dProblem& problem);

 private:
  std::vector<double> cost_;
};

}  // namespace nda::lap
