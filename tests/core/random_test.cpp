#include "core/random.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nda::core {
namespace {

// Recomputed from the published algorithm: splitmix64 fills the state, xoshiro256** runs on it.
// The first outputs for seed 0 are the well-known test values of the two together.
TEST(Random, IsTheSameStreamOnEveryPlatform) {
  Random random(0);
  const std::vector<std::uint64_t> first = {
      0x99ec5f36cb75f2b4ULL, 0xbf6e1f784956452aULL, 0x1a5f849d4933e6e0ULL, 0x6aa594f1262d2d2cULL};
  for (const std::uint64_t value : first) EXPECT_EQ(random(), value);
}

TEST(Random, SameSeedSameStreamOtherSeedOther) {
  Random one(7);
  Random two(7);
  Random other(8);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t value = one();
    EXPECT_EQ(value, two());
    equal += value == other();
  }
  EXPECT_EQ(equal, 0);
}

TEST(Random, UniformStaysInItsRangeAndFillsIt) {
  Random random(1);
  std::vector<int> tenth(10, 0);
  for (int i = 0; i < 10000; ++i) {
    const double x = random.uniform();
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    ++tenth[static_cast<std::size_t>(10 * x)];
    const double y = random.uniform(-3, 5);
    ASSERT_GE(y, -3);
    ASSERT_LT(y, 5);
  }
  for (const int count : tenth) EXPECT_NEAR(count, 1000, 150);
}

TEST(Random, BelowStaysBelowAndReachesAll) {
  Random random(2);
  for (const std::uint64_t n : {1ULL, 2ULL, 7ULL}) {
    std::vector<int> seen(n, 0);
    for (int i = 0; i < 7000; ++i) {
      const std::uint64_t x = random.below(n);
      ASSERT_LT(x, n);
      ++seen[x];
    }
    for (const int count : seen) EXPECT_NEAR(count, 7000.0 / static_cast<double>(n), 300);
  }
  std::uint64_t largest = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t x = random.below(1ULL << 40);
    ASSERT_LT(x, 1ULL << 40);
    largest = std::max(largest, x);
  }
  EXPECT_GT(largest, 1ULL << 36) << "beyond 32 bits";
}

}  // namespace
}  // namespace nda::core
