#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "nda/options.hpp"

namespace nda::relax {

/// The index alignment of one evaluation of the dual function: which pairs (i1, i2) the relaxed
/// solution chose, and where.
struct Alignment {
  std::vector<std::uint32_t> cells;  ///< as DualFunction::aligned_cells()
  std::vector<double> point;         ///< the variables of the dual function
  double value = 0;                  ///< q there
  double violation = 0;              ///< |g|^2 there: how often relaxed indices are not used once
};

/// The best alignments of a nonsmooth optimisation, no two the same, by AlignmentRule.
class AlignmentPool {
 public:
  AlignmentPool(AlignmentRule rule, std::size_t capacity) : rule_(rule), capacity_(capacity) {}

  /// Whether an alignment of these figures would be the best so far.
  bool would_lead(double value, double violation) const {
    return best_.empty() || is_better(value, violation, best_.front());
  }
  /// Whether it is as good as the best so far.
  bool is_level(double value, double violation) const {
    return !best_.empty() && best_.front().value == value &&
           (rule_ == AlignmentRule::kBestValue || best_.front().violation == violation);
  }

  /// Keeps it where it is among the best; of the same pairs the better point.  Copies nothing else.
  void offer(std::span<const std::uint32_t> cells,
             std::span<const double> point,
             double value,
             double violation);

  /// Best first.
  const std::vector<Alignment>& best() const { return best_; }
  std::vector<Alignment> take() { return std::move(best_); }

 private:
  bool is_better(double value, double violation, const Alignment& than) const {
    if (rule_ == AlignmentRule::kLeastViolation && violation != than.violation)
      return violation < than.violation;
    return value > than.value;
  }

  AlignmentRule rule_;
  std::size_t capacity_;
  std::vector<Alignment> best_;
};

}  // namespace nda::relax
