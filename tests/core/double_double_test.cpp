#include "core/double_double.hpp"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace nda::core {
namespace {

using Exact = boost::multiprecision::cpp_rational;

DoubleDouble sum(const std::vector<double>& terms) {
  DoubleDouble result;
  for (const double term : terms) result.add(term);
  return result;
}

TEST(DoubleDouble, StartsAtZeroOrAValue) {
  EXPECT_EQ(DoubleDouble().high(), 0);
  EXPECT_EQ(DoubleDouble().low(), 0);
  EXPECT_EQ(DoubleDouble(3.5).high(), 3.5);
  EXPECT_EQ(DoubleDouble(3.5).low(), 0);
}

TEST(DoubleDouble, KeepsWhatADoubleLoses) {
  const DoubleDouble kept = sum({1, 1e-20, -1});
  EXPECT_EQ(kept.high(), 1e-20);
  EXPECT_EQ(sum({1e12, 1e-12, -1e12}).high(), 1e-12);
  EXPECT_EQ(sum({1e-12, 1e12, -1e12}).high(), 1e-12);
}

TEST(DoubleDouble, IsNegativeBelowZeroOnly) {
  EXPECT_FALSE(DoubleDouble().negative());
  EXPECT_FALSE(sum({1, -1}).negative());
  EXPECT_FALSE(sum({1, 1e-25, -1}).negative());
  EXPECT_TRUE(sum({1, -1e-25, -1}).negative());
  EXPECT_TRUE(DoubleDouble(-1e-300).negative());
}

// Against exact rationals: n additions err by at most n 2^-104 times the sum of the absolute
// values.
TEST(DoubleDouble, ErrsByLessThanItsBound) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    DoubleDouble computed;
    Exact exact = 0;
    Exact magnitude = 0;
    const int n = 2 + static_cast<int>(random.below(60));
    for (int i = 0; i < n; ++i) {
      const double size = std::pow(10.0, random.uniform(-12, 12));
      double term = random.below(2) == 0 ? size : -size;
      if (i + 1 == n) term = -computed.high();  // all digits but the last cancel
      computed.add(term);
      exact += Exact(term);
      magnitude += Exact(std::abs(term));
    }
    const Exact value = Exact(computed.high()) + Exact(computed.low());
    EXPECT_LE(abs(value - exact), n * magnitude * Exact(0x1p-104));
    EXPECT_EQ(computed.high() + computed.low(), computed.high()) << "not normalised";
  }
}

}  // namespace
}  // namespace nda::core
