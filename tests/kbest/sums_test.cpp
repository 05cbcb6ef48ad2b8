#include "kbest/sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "core/random.hpp"

namespace nda::kbest {
namespace {

// Every sum once, with the arcs that belong to it.
TEST(Sums, ComeInOrder) {
  core::Random random(1);
  for (int repeat = 0; repeat < 1000; ++repeat) {
    SCOPED_TRACE(repeat);
    Combinations combinations;
    std::vector<RankedList> lists(random.below(6));
    std::vector<double> slack_of_arc;
    std::vector<double> all = {0};
    for (RankedList& list : lists) {
      list.resize(1 + random.below(4));
      for (Ranked& ranked : list) {
        ranked.slack = static_cast<double>(random.below(8));
        ranked.arcs = combinations.single(static_cast<std::uint32_t>(slack_of_arc.size()));
        slack_of_arc.push_back(ranked.slack);
      }
      std::sort(list.begin(), list.end(), [](const Ranked& a, const Ranked& b) {
        return a.slack < b.slack;
      });
      std::vector<double> longer;
      for (const double sum : all) {
        for (const Ranked& ranked : list) longer.push_back(sum + ranked.slack);
      }
      all = std::move(longer);
    }
    std::sort(all.begin(), all.end());
    std::vector<const RankedList*> pointers;
    for (const RankedList& list : lists) pointers.push_back(&list);
    Sums sums(pointers, combinations);
    std::set<std::vector<std::uint32_t>> different;
    for (const double expected : all) {
      const std::optional<Ranked> sum = sums.next();
      ASSERT_TRUE(sum);
      EXPECT_EQ(sum->slack, expected);
      std::vector<std::uint32_t> arcs = combinations.arcs(sum->arcs);
      std::sort(arcs.begin(), arcs.end());
      EXPECT_EQ(arcs.size(), lists.size());
      double total = 0;
      for (const std::uint32_t arc : arcs) total += slack_of_arc[arc];
      EXPECT_EQ(total, expected);
      EXPECT_TRUE(different.insert(arcs).second);
    }
    EXPECT_FALSE(sums.next());
  }
}

}  // namespace
}  // namespace nda::kbest
