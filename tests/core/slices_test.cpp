#include "core/slices.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace nda::core {
namespace {

TEST(ForEachUntil, VisitsAllInOrder) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, kSlice, 2 * kSlice + 1}) {
    std::size_t next = 0;
    EXPECT_TRUE(for_each_until({}, count, [&](std::size_t i) { EXPECT_EQ(i, next++); }));
    EXPECT_EQ(next, count);
  }
}

TEST(ForEachUntil, StopsWithinASlice) {
  std::stop_source source;
  const Deadline deadline(1e9, source.get_token());
  std::size_t visited = 0;
  EXPECT_FALSE(for_each_until(deadline, 10 * kSlice, [&](std::size_t i) {
    if (i == kSlice + 5) source.request_stop();
    ++visited;
  }));
  EXPECT_EQ(visited, 2 * kSlice);
  EXPECT_FALSE(for_each_until(deadline, 1, [&](std::size_t) { ++visited; }));
  EXPECT_EQ(visited, 2 * kSlice);
}

TEST(SortUntil, SortsAsTheStandardDoes) {
  Random random(1);
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{7}, kSlice, kSlice + 1, 3 * kSlice, 5 * kSlice + 3}) {
    std::vector<std::uint64_t> items(count);
    for (std::uint64_t& item : items) item = random.below(1000);
    std::vector<std::uint64_t> expected = items;
    std::sort(expected.begin(), expected.end());
    EXPECT_TRUE(sort_until({}, items, std::less<>()));
    EXPECT_EQ(items, expected);
  }
}

TEST(SortUntil, SaysWhereItWasCutShort) {
  std::vector<int> items(100, 1);
  EXPECT_FALSE(sort_until(Deadline(0), items, std::less<>()));
}

TEST(Deadline, BeatsWhenAsked) {
  int beats = 0;
  const std::function<void()> beat = [&] { ++beats; };
  const Deadline deadline(1e9, {}, &beat);
  EXPECT_FALSE(deadline.reached());
  EXPECT_FALSE(deadline.earlier(10).reached());
  EXPECT_TRUE(deadline.earlier(1e9).reached());
  EXPECT_EQ(beats, 3);
}

}  // namespace
}  // namespace nda::core
