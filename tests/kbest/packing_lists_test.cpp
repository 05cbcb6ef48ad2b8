#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/random.hpp"
#include "kbest/packing_buffer.hpp"
#include "kbest/packing_sums.hpp"

namespace nda::kbest {
namespace {

using core::Packing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<double> costs_of(const std::vector<Packing>& packings) {
  std::vector<double> costs;
  for (const Packing& packing : packings) costs.push_back(packing.cost);
  return costs;
}

TEST(PackingBuffer, KeepsTheBestOnceEach) {
  PackingBuffer buffer(3);
  EXPECT_EQ(buffer.cutoff(), kInfinity);
  for (const Packing& packing : {Packing{{1}, -1}, {{2}, -3}, {{1}, -1}, {{3}, -1}, {{4}, -2}})
    buffer.add(packing);
  EXPECT_EQ(buffer.cutoff(), -1);
  EXPECT_THAT(costs_of(buffer.take()), ElementsAre(-3, -2, -1));
}

// Against a list that is sorted and looked through every time; of few costs, so that most are ties.
TEST(PackingBuffer, AgreesWithAPlainList) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    std::size_t k = 1 + random.below(30);
    PackingBuffer buffer(k);
    std::vector<Packing> plain;
    for (int n = 0; n < 200; ++n) {
      if (random.below(40) == 0) {
        k = 1 + random.below(30);
        buffer.resize(k);
        if (plain.size() > k) plain.resize(k);
      }
      const auto arc = static_cast<core::ArcId>(random.below(150));
      const Packing packing = {{arc, arc + 1000}, static_cast<double>(arc % 7)};
      const auto is_same = [&](const Packing& other) { return other.arcs == packing.arcs; };
      const bool is_new = std::ranges::none_of(plain, is_same);
      const bool fits = plain.size() < k || (plain.size() == k && packing.cost < plain.back().cost);
      if (is_new && fits) plain.push_back(packing);
      std::ranges::stable_sort(plain, {}, &Packing::cost);
      if (plain.size() > k) plain.resize(k);
      EXPECT_EQ(buffer.add(packing), is_new && fits);
      EXPECT_EQ(buffer.cutoff(), plain.size() < k ? kInfinity : plain.back().cost);
      if (random.below(3) != 0) continue;
      ASSERT_EQ(buffer.packings().size(), plain.size());
      for (std::size_t r = 0; r < plain.size(); ++r)
        ASSERT_EQ(*buffer.packings()[r].arcs, plain[r].arcs);
    }
    const std::vector<Packing> taken = buffer.take();
    ASSERT_EQ(costs_of(taken), costs_of(plain));
    EXPECT_EQ(buffer.size(), 0u);
  }
}

// Comparing each with all others would end in no time that a test has.
TEST(PackingBuffer, TakesVeryManyOfOneCost) {
  constexpr core::ArcId kMany = 300000;
  PackingBuffer buffer(kMany);
  for (int time = 0; time < 2; ++time) {
    for (core::ArcId a = 0; a < kMany; ++a) EXPECT_EQ(buffer.add({{a, a + kMany}, 1}), time == 0);
  }
  EXPECT_EQ(buffer.cutoff(), 1);
}

TEST(PackingLists, HandOnAFewWhateverTheClockSays) {
  std::vector<Packing> packings;
  for (core::ArcId a = 0; a < 50; ++a) packings.push_back({{a}, static_cast<double>(a)});
  const core::Deadline passed(0);
  EXPECT_EQ(cheapest_choices({packings}, 50, passed).size(), kFewPackings);
  PackingBuffer few(50);
  few.add_best(packings, passed);
  EXPECT_EQ(few.size(), kFewPackings);
  PackingBuffer all(50);
  all.add_best(packings, {});
  EXPECT_EQ(all.size(), packings.size());
  EXPECT_EQ(costs_of(all.take(passed)), costs_of(few.take()));
  EXPECT_EQ(all.size(), 0u);
}

TEST(CheapestChoices, HasNoWayThroughAnEmptyList) {
  EXPECT_THAT(cheapest_choices({}, 4), ElementsAre(IsEmpty())) << "one way to choose of no lists";
  EXPECT_EQ(cheapest_choices({{{{1}, -2}, {{}, 0}}}, 4).size(), 2u);
  EXPECT_THAT(cheapest_choices({{{{1}, -2}}, {}}, 4), IsEmpty());
}

// Against all sums of up to four lists.
TEST(CheapestChoices, AgreesWithAllSums) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    core::Random random(seed);
    const std::size_t k = 1 + random.below(12);
    std::vector<double> all = {0};
    std::vector<std::vector<Packing>> lists;
    for (std::uint64_t list = random.below(5); list > 0; --list) {
      std::vector<double> costs(1 + random.below(5));
      for (double& cost : costs) cost = static_cast<double>(random.below(20)) - 15;
      std::sort(costs.begin(), costs.end());
      std::vector<Packing> packings;
      for (const double cost : costs) packings.push_back({{}, cost});
      std::vector<double> longer;
      for (const double sum : all) {
        for (const double cost : costs) longer.push_back(sum + cost);
      }
      all = longer;
      lists.push_back(packings);
    }
    std::sort(all.begin(), all.end());
    const std::vector<PackingChoice> choices = cheapest_choices(lists, k);
    ASSERT_EQ(choices.size(), std::min(k, all.size())) << seed;
    for (std::size_t n = 0; n < choices.size(); ++n) {
      EXPECT_EQ(choices[n].size(), lists.size());
      double chosen = 0;
      for (const auto& [list, i] : choices[n]) chosen += lists[list][i].cost;
      EXPECT_EQ(chosen, all[n]) << seed;
    }
  }
}

}  // namespace
}  // namespace nda::kbest
