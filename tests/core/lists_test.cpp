#include "core/lists.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/cheapest.hpp"
#include "core/component.hpp"

namespace nda::core {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Lists, HoldTheItemsOfEveryKeyInTheOrderOfTheirComing) {
  const std::vector<std::pair<std::size_t, int>> pairs = {{2, 7}, {0, 5}, {2, 3}, {0, 5}};
  Lists<int> lists(4, [&](auto&& visit) {
    for (const auto& [key, item] : pairs) visit(key, item);
  });
  EXPECT_THAT(lists[0], ElementsAre(5, 5));
  EXPECT_THAT(lists[1], IsEmpty());
  EXPECT_THAT(lists[2], ElementsAre(7, 3));
  EXPECT_THAT(lists[3], IsEmpty());
  std::swap(lists.list(2)[0], lists.list(2)[1]);
  EXPECT_THAT(lists[2], ElementsAre(3, 7));
}

TEST(KeepCheapest, KeepsTheFirstOfEqualOnes) {
  const std::vector<double> key = {4, 1, 3, 1, 0, 3};
  std::vector<ArcId> arcs = {5, 4, 3, 2, 1, 0};
  const auto of = [&](ArcId a) { return key[a]; };
  keep_cheapest(arcs, 6, of);
  EXPECT_THAT(arcs, ElementsAre(5, 4, 3, 2, 1, 0));
  keep_cheapest(arcs, 4, of);
  EXPECT_THAT(arcs, ElementsAre(1, 2, 3, 4));
  keep_cheapest(arcs, 2, of);
  EXPECT_THAT(arcs, ElementsAre(1, 4));
  keep_cheapest(arcs, 0, of);
  EXPECT_THAT(arcs, IsEmpty());
}

TEST(Positions, LeadThereAndBack) {
  const std::vector<ArcId> list = {2, 3, 5, 8};
  EXPECT_THAT(positions_in(list, std::vector<ArcId>{8, 4, 2, 9}), ElementsAre(3, 0));
  EXPECT_THAT(at_positions(list, std::vector<ArcId>{3, 0}), ElementsAre(8, 2));
}

}  // namespace
}  // namespace nda::core
