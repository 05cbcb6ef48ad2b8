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

TEST(PackingSums, HasNoWayThroughAnEmptyList) {
  PackingSums sums(4);
  EXPECT_EQ(sums.size(), 1u) << "one way to choose of no lists";
  sums.add({{{1}, -2}, {{}, 0}});
  EXPECT_EQ(sums.size(), 2u);
  sums.add({});
  EXPECT_EQ(sums.size(), 0u);
}

// Against all sums of up to four lists.
TEST(PackingSums, AgreesWithAllSums) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    core::Random random(seed);
    const std::size_t k = 1 + random.below(12);
    PackingSums sums(k);
    std::vector<double> all = {0};
    std::vector<std::vector<double>> lists;
    for (std::uint64_t list = random.below(5); list > 0; --list) {
      std::vector<double> costs(1 + random.below(5));
      for (double& cost : costs) cost = static_cast<double>(random.below(20)) - 15;
      std::sort(costs.begin(), costs.end());
      std::vector<Packing> packings;
      for (const double cost : costs) packings.push_back({{}, cost});
      sums.add(packings);
      std::vector<double> longer;
      for (const double sum : all) {
        for (const double cost : costs) longer.push_back(sum + cost);
      }
      all = longer;
      lists.push_back(costs);
    }
    std::sort(all.begin(), all.end());
    ASSERT_EQ(sums.size(), std::min(k, all.size())) << seed;
    for (std::size_t n = 0; n < sums.size(); ++n) {
      EXPECT_EQ(sums.cost(n), all[n]) << seed;
      double chosen = 0;
      const PackingSums::Choice choice = sums.choice(n);
      EXPECT_EQ(choice.size(), lists.size());
      for (const auto& [list, i] : choice) chosen += lists[list][i];
      EXPECT_EQ(chosen, all[n]) << seed;
    }
  }
}

}  // namespace
}  // namespace nda::kbest
