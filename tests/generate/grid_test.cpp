#include "generate/grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "generate/portable.hpp"

namespace nda::generate {
namespace {

std::vector<std::uint32_t> within(const Grid& grid, Point centre, double radius) {
  std::vector<std::uint32_t> found;
  grid.for_each_within(centre, radius, [&](std::uint32_t j, double) { found.push_back(j); });
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Grid, FindsWhatABruteSearchFinds) {
  Draw draw(1);
  for (int round = 0; round < 50; ++round) {
    SCOPED_TRACE(round);
    Scan scan;
    const std::int64_t count = draw.integer(0, 60);
    for (std::int64_t j = 0; j < count; ++j) {
      const double x = 100 * draw.uniform() - 50;
      scan.push_back({x, 30 * draw.uniform()});
    }
    std::sort(scan.begin(), scan.end(), [](Point a, Point b) { return a.x < b.x; });
    const Grid grid(scan, 0.1 + 20 * draw.uniform());
    for (int query = 0; query < 50; ++query) {
      const double x = 200 * draw.uniform() - 100;
      const Point centre = {x, 80 * draw.uniform() - 20};
      const double radius = 40 * draw.uniform();
      std::vector<std::uint32_t> expected;
      for (std::uint32_t j = 0; j < scan.size(); ++j) {
        const double dx = scan[j].x - centre.x, dy = scan[j].y - centre.y;
        if (dx * dx + dy * dy <= radius * radius) expected.push_back(j);
      }
      EXPECT_EQ(within(grid, centre, radius), expected);
    }
  }
}

TEST(Grid, TakesScansOfOnePointAndOfNone) {
  EXPECT_TRUE(within(Grid({}, 1), {0, 0}, 5).empty());
  EXPECT_THAT(within(Grid({{3, 4}}, 1), {0, 0}, 5), ::testing::ElementsAre(0));
  EXPECT_TRUE(within(Grid({{3, 4}}, 1), {0, 0}, 4.9).empty());
}

}  // namespace
}  // namespace nda::generate
