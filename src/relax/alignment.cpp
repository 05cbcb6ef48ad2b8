#include "relax/alignment.hpp"

#include <algorithm>

// Index-alignment selection: the dual function is flat near its maximum, where many multipliers
// with different alignments are as good.  The subgradient counts violated constraints, so a short
// one promises a small duality gap: among alignments the one with the shorter subgradient comes
// first, then the one of better value.  Source: the paper on partial branch and bound, section 3.1.
// Far from the maximum the rule misleads, as the paper says; kBestValue is the plain choice.

namespace nda::relax {

void AlignmentPool::offer(std::span<const std::uint32_t> cells,
                          std::span<const double> point,
                          double value,
                          double violation) {
  const auto is_worse = [&](const Alignment& other) { return is_better(value, violation, other); };
  const auto is_same = [&](const Alignment& other) {
    return std::ranges::equal(other.cells, cells);
  };
  const std::size_t place =
      static_cast<std::size_t>(std::ranges::find_if(best_, is_worse) - best_.begin());
  if (place >= capacity_) return;
  const std::size_t same =
      static_cast<std::size_t>(std::ranges::find_if(best_, is_same) - best_.begin());
  if (same < place) return;
  // The one that goes leaves its memory to the new one.
  if (same == best_.size() && best_.size() < capacity_) best_.emplace_back();
  const auto gone = best_.begin() + static_cast<std::ptrdiff_t>(std::min(same, best_.size() - 1));
  std::rotate(best_.begin() + static_cast<std::ptrdiff_t>(place), gone, gone + 1);
  Alignment& alignment = best_[place];
  alignment.cells.assign(cells.begin(), cells.end());
  alignment.point.assign(point.begin(), point.end());
  alignment.value = value;
  alignment.violation = violation;
}

}  // namespace nda::relax
