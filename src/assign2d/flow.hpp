#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "nda/types.hpp"

namespace nda::lap {

/// A row or column of a two-dimensional problem with bounds: used at most `hi` times; every use
/// short of `lo` costs `single`, and is forbidden where that is +inf.  lo <= hi, all hi together
/// are below 2^31; single >= 0 where lo < hi.
struct FlowNode {
  double single = 0;
  Index lo = 0;
  Index hi = 0;
};

/// What may be chosen once, or `most` times where row or column let it: a use of a row and a
/// column, or of one of them.
struct FlowEdge {
  static constexpr std::uint32_t kOutside = ~std::uint32_t{0};

  std::uint32_t row;     ///< kOutside: none
  std::uint32_t column;  ///< kOutside: none; never both
  double cost;           ///< +inf: forbidden
  Index most = 1;        ///< more than a node may be used: its reduced cost is never negative
};

/// The answer.  With f(n) = single * max(0, lo - n) the duals prove it:
///
///     sum over rows and columns of min over 0 <= n <= hi of f(n) + u n
///     + sum over edges of min(0, cost - u[row] - v[column])                   =  cost (to
///     rounding)
struct FlowAnswer {
  bool feasible = true;
  bool exact = true;  ///< the costs lie on the grid of integers that was used: so do the duals
  std::vector<std::uint32_t> chosen;  ///< edges, ascending
  std::vector<double> u;              ///< [row]; 0 of whatever is outside
  std::vector<double> v;              ///< [column]
};

/// Minimum-cost flow by LEMON's network simplex; the only place that knows LEMON.  Not exact: the
/// answer is best to about 2^-40 of the largest cost.  Where it is not feasible nothing but that is
/// of use.  Edges may be parallel.
FlowAnswer solve_flow(std::span<const FlowNode> rows,
                      std::span<const FlowNode> columns,
                      std::span<const FlowEdge> edges);

}  // namespace nda::lap
