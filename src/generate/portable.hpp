#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "nda/types.hpp"

// Random variables and functions that give the same bits everywhere: only + - * / and sqrt, which
// IEEE 754 rounds exactly, and no contraction of a * b + c (the build says -ffp-contract=off).

namespace nda::generate {

/// Natural logarithm of x > 0 (normal), relative error below 1e-15.
double natural_log(double x);

inline constexpr double kPi = 3.14159265358979323846;

/// A cost in millionths.
using Micro = std::int64_t;

inline constexpr Micro kMicrosPerUnit = 1000000;

/// Nearest number of millionths, halves away from 0; |x| < 1e12.
Micro to_micro(double x);

/// The double nearest to m / 10^6: what reading the decimal number gives.
inline double from_micro(Micro m) {
  return static_cast<double>(m) / static_cast<double>(kMicrosPerUnit);
}

/// The shortest decimal number, e.g. -12.5.
std::string decimal(Micro m);

/// Random variables over one xoshiro256** stream.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t n) { return random_.below(n); }
  double uniform() { return random_.uniform(); }

  /// Uniform among low..high, low <= high.
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return low +
           static_cast<std::int64_t>(random_.below(static_cast<std::uint64_t>(high - low) + 1));
  }

  /// Standard normal (Marsaglia's polar method).
  double gaussian();

  /// Number of events of a Poisson process in time `mean`; O(mean).
  int poisson(double mean);

  /// Uniform in the disc of this radius.
  void disc(double radius, double& x, double& y);

  /// Fisher-Yates.
  template <typename T>
  void shuffle(std::vector<T>& values) {
    core::shuffle(values, *this);
  }

  /// `count` distinct numbers of 0..total-1, ascending; count <= total.  O(count log count)
  /// (Floyd).
  std::vector<std::uint64_t> distinct(std::uint64_t count, std::uint64_t total);

 private:
  core::Random random_;
  double spare_ = 0;
  bool has_spare_ = false;
};

/// What a generated problem may have: indices of all dimensions together, arcs times dimensions,
/// detections of all scans together.
inline constexpr double kMostIndices = 1e8;
inline constexpr double kMostEntries = 1e9;
inline constexpr double kMostDetections = 1e7;

/// The shortest decimal number that reads back as x; without exponent where `fixed`.
std::string shortest(double x, bool fixed = false);

/// Throws InputError "<name> is <value>, <need>" unless `holds`.
void require(bool holds, const std::string& name, double value, const std::string& need);

/// Throws InputError "<name> is <value>, must be in [<least>, <most>]"; NaN is in no range.
void require_within(const std::string& name, double value, double least, double most);

/// Throws InputError unless the problem is within kMostIndices and kMostEntries.
void require_moderate(int dimensions, double largest_size, double num_arcs);

/// Product of all sizes (+ 1 where `with_dummy`); throws InputError at 2^limit_bits or more.
std::uint64_t count_tuples(const std::vector<Index>& sizes, bool with_dummy, int limit_bits);

/// M_k uniform in min_size..max_size; throws InputError unless min_size <= max_size.
std::vector<Index> draw_sizes(Draw& draw, int dimensions, Index min_size, Index max_size);

}  // namespace nda::generate
