#include "generate/portable.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <unordered_set>

// The standard library promises neither the bits of std::log nor the algorithm of its
// distributions, so a benchmark file made with them differs between platforms.  Here a logarithm is
// a series over the mantissa: log x = e log 2 + 2 atanh(s), s = (m - 1) / (m + 1), with m in
// [sqrt(1/2), sqrt(2)], so |s| < 0.1716 and twelve terms leave an error of 0.1716^25 / 25 < 1e-20.

namespace nda::generate {

double natural_log(double x) {
  constexpr double kLog2 = 0.693147180559945309417;
  constexpr double kSqrt2 = 1.41421356237309504880;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double mantissa = std::bit_cast<double>((bits & 0xfffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa > kSqrt2) {
    mantissa *= 0.5;
    ++exponent;
  }
  const double s = (mantissa - 1) / (mantissa + 1);
  const double s2 = s * s;
  double series = 0;
  for (int j = 12; j >= 0; --j) series = series * s2 + 1.0 / (2 * j + 1);
  return exponent * kLog2 + 2 * s * series;
}

Micro to_micro(double x) {
  const double scaled = x * static_cast<double>(kMicrosPerUnit);
  return static_cast<Micro>(scaled < 0 ? scaled - 0.5 : scaled + 0.5);
}

std::string decimal(Micro m) {
  const Micro size = m < 0 ? -m : m;
  std::string text = m < 0 ? "-" : "";
  text += std::to_string(size / kMicrosPerUnit);
  const Micro fraction = size % kMicrosPerUnit;
  if (fraction == 0) return text;
  const std::string digits = std::to_string(kMicrosPerUnit + fraction).substr(1);
  text += '.';
  text.append(digits, 0, digits.find_last_not_of('0') + 1);
  return text;
}

double Draw::gaussian() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  double x = 0, y = 0, r2 = 0;
  do {
    x = 2 * uniform() - 1;
    y = 2 * uniform() - 1;
    r2 = x * x + y * y;
  } while (r2 >= 1 || r2 == 0);
  const double factor = std::sqrt(-2 * natural_log(r2) / r2);
  spare_ = y * factor;
  has_spare_ = true;
  return x * factor;
}

int Draw::poisson(double mean) {
  int count = -1;
  double time = 0;
  do {
    time -= natural_log(1 - uniform());
    ++count;
  } while (time < mean);
  return count;
}

void Draw::disc(double radius, double& x, double& y) {
  do {
    x = 2 * uniform() - 1;
    y = 2 * uniform() - 1;
  } while (x * x + y * y > 1);
  x *= radius;
  y *= radius;
}

std::vector<std::uint64_t> Draw::distinct(std::uint64_t count, std::uint64_t total) {
  std::unordered_set<std::uint64_t> chosen;
  chosen.reserve(count);
  for (std::uint64_t j = total - count; j < total; ++j) {
    if (!chosen.insert(below(j + 1)).second) chosen.insert(j);
  }
  std::vector<std::uint64_t> sorted(chosen.begin(), chosen.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::string shortest(double x, bool fixed) {
  char text[400];
  char* const end = text + sizeof text;
  const auto result =
      fixed ? std::to_chars(text, end, x, std::chars_format::fixed) : std::to_chars(text, end, x);
  return {text, result.ptr};
}

void require(bool holds, const std::string& name, double value, const std::string& need) {
  if (!holds) throw InputError(name + " is " + shortest(value) + ", " + need);
}

void require_within(const std::string& name, double value, double least, double most) {
  require(value >= least && value <= most,
          name,
          value,
          "must be in [" + shortest(least) + ", " + shortest(most) + "]");
}

void require_moderate(int dimensions, double largest_size, double num_arcs) {
  require_within("dimensions times size", dimensions * largest_size, 0, kMostIndices);
  require_within("dimensions times arcs", dimensions * num_arcs, 0, kMostEntries);
}

std::uint64_t count_tuples(const std::vector<Index>& sizes, bool with_dummy, int limit_bits) {
  const std::uint64_t limit = std::uint64_t{1} << limit_bits;
  std::uint64_t count = 1;
  for (const Index size : sizes) {
    const std::uint64_t choices = size + (with_dummy ? std::uint64_t{1} : 0);
    if (count > (limit - 1) / choices) {
      throw InputError("dimensions and sizes allow 2^" + std::to_string(limit_bits) +
                       " tuples or more, must be fewer");
    }
    count *= choices;
  }
  return count;
}

std::vector<Index> draw_sizes(Draw& draw, int dimensions, Index min_size, Index max_size) {
  require(max_size >= min_size,
          "max_size",
          max_size,
          "must be at least min_size, which is " + std::to_string(min_size));
  std::vector<Index> sizes(static_cast<std::size_t>(dimensions));
  for (Index& size : sizes) size = static_cast<Index>(draw.integer(min_size, max_size));
  return sizes;
}

}  // namespace nda::generate
