#pragma once

#include <cmath>
#include <cstddef>

#include "core/double_double.hpp"
#include "nda/types.hpp"

namespace nda::core {

/// The terms of a bound, and the sum of their absolute values.  Neighbours go to different sums, so
/// that no addition waits for the one before.
///
/// Each of the T additions errs by at most 2^-104 of a partial sum, no partial sum exceeds the sum
/// S of the absolute values of all terms, so the whole errs by less than T 2^-104 S.  Where that
/// underflows the next double above it is taken.
class CertificateSum {
 public:
  void add(std::size_t position, double term) {
    sums_[position % kSums].add(term);
    magnitude_ += std::abs(term);
  }
  void enlarge(double magnitude) { magnitude_ += magnitude; }

  /// Not above the exact sum of what was added in at most so many terms (6 or more).  The few
  /// additions here are covered too, as 2^-100 is sixteen times what one term needs.
  double rounded_down(double terms) const {
    if (magnitude_ == 0) return 0;
    if (!std::isfinite(magnitude_)) return -kInfinity;
    DoubleDouble total;
    for (const DoubleDouble& sum : sums_) {
      total.add(sum.high());
      total.add(sum.low());
    }
    const double error = std::nextafter(terms * 0x1p-100 * magnitude_, kInfinity);
    total.add(-error);
    return std::nextafter(total.high(), -kInfinity);
  }

 private:
  static constexpr std::size_t kSums = 8;

  DoubleDouble sums_[kSums];
  double magnitude_ = 0;
};

}  // namespace nda::core
