#include "generate/portable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace nda::generate {
namespace {

TEST(NaturalLog, AgreesWithTheLibrary) {
  Draw draw(1);
  for (int i = 0; i < 100000; ++i) {
    const double x = std::ldexp(1 + draw.uniform(), static_cast<int>(draw.integer(-1000, 1000)));
    EXPECT_NEAR(natural_log(x), std::log(x), 4e-16 * std::abs(std::log(x)) + 1e-300) << x;
  }
  for (const double x : {0.999, 1.001, 0.7071, 0.7072, 1.4142, 1.4143}) {
    EXPECT_NEAR(natural_log(x), std::log(x), 1e-15 * std::abs(std::log(x))) << x;
  }
  EXPECT_EQ(natural_log(1), 0);
}

TEST(Micro, RoundsToTheNearestAndPrintsTheShortestDecimal) {
  EXPECT_EQ(to_micro(1.0000004), 1000000);
  EXPECT_EQ(to_micro(1.0000006), 1000001);
  EXPECT_EQ(to_micro(-1.0000006), -1000001);
  EXPECT_EQ(decimal(0), "0");
  EXPECT_EQ(decimal(-12500000), "-12.5");
  EXPECT_EQ(decimal(1), "0.000001");
  EXPECT_EQ(decimal(-7000000), "-7");
  EXPECT_EQ(decimal(10203040), "10.20304");
}

TEST(Micro, BecomesTheDoubleThatReadingGives) {
  Draw draw(2);
  for (int i = 0; i < 10000; ++i) {
    const Micro m = draw.integer(-100000000000, 100000000000);
    EXPECT_EQ(from_micro(m), std::stod(decimal(m)));
  }
}

// Mean and variance of n draws.
template <typename Next>
std::pair<double, double> moments(int n, Next next) {
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = next();
    sum += x;
    squares += x * x;
  }
  return {sum / n, squares / n - sum / n * (sum / n)};
}

TEST(Draw, HasTheMomentsOfItsDistributions) {
  constexpr int kDraws = 200000;  // standard error of a mean: deviation / 447
  Draw draw(3);
  const auto gaussian = moments(kDraws, [&] { return draw.gaussian(); });
  EXPECT_NEAR(gaussian.first, 0, 0.012);
  EXPECT_NEAR(gaussian.second, 1, 0.02);
  const auto poisson = moments(kDraws, [&] { return draw.poisson(3.5); });
  EXPECT_NEAR(poisson.first, 3.5, 0.022);
  EXPECT_NEAR(poisson.second, 3.5, 0.08);
  const auto radius = moments(kDraws, [&] {
    double x = 0, y = 0;
    draw.disc(2, x, y);
    return x * x + y * y;  // uniform in [0, 4]
  });
  EXPECT_NEAR(radius.first, 2, 0.014);
  EXPECT_NEAR(radius.second, 16.0 / 12, 0.02);
  const auto integer = moments(kDraws, [&] { return static_cast<double>(draw.integer(-2, 2)); });
  EXPECT_NEAR(integer.first, 0, 0.017);
  EXPECT_NEAR(integer.second, 2, 0.03);
}

TEST(Draw, GaussianTailsAreThere) {
  Draw draw(4);
  int beyond_two = 0;
  for (int i = 0; i < 100000; ++i) beyond_two += std::abs(draw.gaussian()) > 2;
  EXPECT_NEAR(beyond_two, 4550, 350);
}

TEST(Draw, DistinctNumbersAreDistinctAscendingAndUniform) {
  Draw draw(5);
  std::vector<int> hits(10, 0);
  for (int i = 0; i < 30000; ++i) {
    const auto numbers = draw.distinct(3, 10);
    ASSERT_EQ(numbers.size(), 3u);
    EXPECT_TRUE(numbers[0] < numbers[1] && numbers[1] < numbers[2] && numbers[2] < 10);
    for (const std::uint64_t n : numbers) ++hits[n];
  }
  for (const int count : hits) EXPECT_NEAR(count, 9000, 400);
  EXPECT_THAT(draw.distinct(4, 4), ::testing::ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(draw.distinct(0, 4).empty());
}

TEST(Draw, ShuffleMakesAllPermutations) {
  Draw draw(6);
  std::set<std::vector<int>> seen;
  for (int i = 0; i < 500; ++i) {
    std::vector<int> values = {1, 2, 3, 4};
    draw.shuffle(values);
    seen.insert(values);
  }
  EXPECT_EQ(seen.size(), 24u);
}

TEST(CountTuples, RefusesTooMany) {
  EXPECT_EQ(count_tuples({3, 4}, false, 32), 12u);
  EXPECT_EQ(count_tuples({3, 4}, true, 32), 20u);
  EXPECT_EQ(count_tuples({65535, 65535}, false, 32), 65535ull * 65535);
  EXPECT_THROW(count_tuples({65536, 65536}, false, 32), InputError);
}

}  // namespace
}  // namespace nda::generate
