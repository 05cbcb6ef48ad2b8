#include "kbest/combinations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.hpp"
#include "nda/types.hpp"

namespace nda::kbest {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::vector<double> slacks_of(const RankedList& list) {
  std::vector<double> slacks;
  for (const Ranked& ranked : list) slacks.push_back(ranked.slack);
  return slacks;
}

TEST(Combinations, JoinsSetsThatShareTheirParts) {
  Combinations combinations;
  const Combination a = combinations.single(7);
  const Combination b = combinations.join(a, combinations.single(0));
  EXPECT_THAT(combinations.arcs(kNothing), IsEmpty());
  EXPECT_THAT(combinations.arcs(combinations.join(kNothing, a)), ElementsAre(7));
  EXPECT_THAT(combinations.arcs(combinations.join(b, combinations.single(3))),
              UnorderedElementsAre(0, 3, 7));
  EXPECT_THAT(combinations.arcs(b), UnorderedElementsAre(0, 7));
}

TEST(MergeRanked, KeepsTheLeast) {
  RankedList list = {{1}, {4}, {6}};
  merge_ranked(list, {{0}, {4}, {5}}, 4);
  EXPECT_THAT(slacks_of(list), ElementsAre(0, 1, 4, 4));
}

// a = {0, 2}, b = {0, 1, 3}: sums 0, 1, 2, 3, 3, 5.
TEST(CombineRanked, FindsTheLeastSums) {
  Combinations combinations;
  const RankedList a = {{0, combinations.single(1)}, {2, combinations.single(2)}};
  const RankedList b = {{0, combinations.single(3)}, {1, combinations.single(4)}, {3, kNothing}};
  const RankedList sums = combine_ranked(a, b, 4, kInfinity, combinations);
  EXPECT_THAT(slacks_of(sums), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(combinations.arcs(sums[1].arcs), UnorderedElementsAre(1, 4));
  EXPECT_THAT(combinations.arcs(sums[2].arcs), UnorderedElementsAre(2, 3));
  EXPECT_THAT(slacks_of(combine_ranked(a, b, 9, 3, combinations)), ElementsAre(0, 1, 2));
  EXPECT_THAT(combine_ranked(a, {}, 9, kInfinity, combinations), IsEmpty());
}

// A million sums would be made of these; the clock is looked at after some thousand.
TEST(CombineRanked, StopsAtTheDeadline) {
  Combinations combinations;
  RankedList list(1000);
  for (std::size_t i = 0; i < list.size(); ++i) list[i].slack = static_cast<double>(i);
  const core::Deadline passed(-1);
  const RankedList sums =
      combine_ranked(list, list, 1u << 30, kInfinity, combinations, nullptr, passed);
  EXPECT_LT(sums.size(), 10000u);
  EXPECT_GT(sums.size(), 1000u);
}

TEST(CombineRanked, AgreesWithAllSums) {
  core::Random random(1);
  for (int repeat = 0; repeat < 500; ++repeat) {
    Combinations combinations;
    RankedList a(1 + random.below(8));
    RankedList b(1 + random.below(8));
    for (RankedList* list : {&a, &b}) {
      for (Ranked& ranked : *list) ranked.slack = static_cast<double>(random.below(10));
      std::sort(list->begin(), list->end(), [](const Ranked& x, const Ranked& y) {
        return x.slack < y.slack;
      });
    }
    std::vector<double> sums;
    for (const Ranked& x : a) {
      for (const Ranked& y : b) sums.push_back(x.slack + y.slack);
    }
    std::sort(sums.begin(), sums.end());
    const std::size_t k = 1 + random.below(70);
    if (sums.size() > k) sums.resize(k);
    EXPECT_EQ(slacks_of(combine_ranked(a, b, k, kInfinity, combinations)), sums);
  }
}

}  // namespace
}  // namespace nda::kbest
