#include "core/nested_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nda::core {
namespace {

using ::testing::ElementsAre;

TEST(NestedSet, KeepsFewerOnItsWayDownAndHasThemBackOnItsWayUp) {
  NestedSet set(6);
  const NestedSet::Range all = set.range();
  set.keep_if([](std::uint32_t n) { return n % 2 == 1; });
  EXPECT_THAT(set.members(), ElementsAre(1, 3, 5));
  EXPECT_TRUE(set.contains(3));
  EXPECT_FALSE(set.contains(2));
  const NestedSet::Range odd = set.range();
  set.keep_if([](std::uint32_t n) { return n > 2; });
  EXPECT_THAT(set.members(), ElementsAre(3, 5));
  set.set_range(odd);
  EXPECT_THAT(set.members(), ::testing::UnorderedElementsAre(1, 3, 5));
  set.set_range(all);
  EXPECT_EQ(set.members().size(), 6);
  EXPECT_TRUE(set.contains(2));
}

TEST(NestedSet, DividesByKeys) {
  NestedSet set(7);
  set.keep_if([](std::uint32_t n) { return n != 3; });
  const auto ranges = set.divide(4, [](std::uint32_t n) { return n % 3 == 2 ? 3 : n % 3; });
  ASSERT_EQ(ranges.size(), 4);
  set.set_range(ranges[0]);
  EXPECT_THAT(set.members(), ElementsAre(0, 6));
  set.set_range(ranges[1]);
  EXPECT_THAT(set.members(), ElementsAre(1, 4));
  EXPECT_FALSE(set.contains(0));
  set.set_range(ranges[2]);
  EXPECT_EQ(set.members().size(), 0);
  set.set_range(ranges[3]);
  EXPECT_THAT(set.members(), ElementsAre(2, 5));
}

}  // namespace
}  // namespace nda::core
