#include "kbest/tree_ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "counted_clock.hpp"
#include "kbest/nearby_packings.hpp"
#include "support/components.hpp"

namespace nda::kbest {
namespace {

using core::Component;

// Whole numbers or any; rows of all prices, some to be used up.
struct Instance {
  Component component;
  bnb::SlackProblem slack{0};
};

Instance random_instance(std::uint64_t seed) {
  core::Random random(seed);
  support::RandomComponentOptions options;
  options.sizes = seed % 2 == 0 ? std::vector<Index>{4, 3, 4} : std::vector<Index>{3, 2, 3, 3};
  options.num_arcs = 6 + static_cast<int>(random.below(10));
  options.dummy_share = 0.2;
  options.positive_share = 0.4;
  options.integer = seed % 3 != 0;
  Instance instance{support::random_component(seed, options)};
  const Component& component = instance.component;
  const auto draw = [&](double most) {
    const double x = random.uniform(0, most);
    return options.integer ? std::floor(x) : x;
  };
  bnb::SlackProblem& slack = instance.slack =
      bnb::SlackProblem(static_cast<std::uint32_t>(component.num_slots()));
  std::vector<double> price(component.num_slots(), 0.0);
  core::for_each_index(component, [&](std::uint32_t slot, std::size_t, Index) {
    price[slot] = seed % 5 == 0 && random.below(6) == 0 ? kInfinity : draw(6);
  });
  for (const double p : price) slack.add_row(p);
  std::vector<bnb::RowUse> uses;
  for (core::ArcId a = 0; a < component.num_arcs(); ++a) {
    uses.clear();
    core::for_each_slot(component, a, [&](std::uint32_t slot) { uses.push_back({slot, 1}); });
    slack.add_arc(draw(8), uses);
  }
  return instance;
}

// Of all packings that use up what must be, ascending.
std::vector<double> all_slacks(const Instance& instance) {
  std::vector<double> all;
  for (const core::Packing& packing : support::all_packings(instance.component)) {
    const double slack = slack_of_packing(instance.slack, packing.arcs);
    if (slack < kInfinity) all.push_back(slack);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(RankByTree, AgreesWithBruteForce) {
  std::int64_t branched = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = random_instance(seed);
    const std::vector<double> all = all_slacks(instance);
    if (all.size() > 100) continue;  // they take their time
    const double margin = seed % 3 != 0 && seed % 2 == 0 ? 0.5 : 0;
    for (const double share : {0.3, 1.1}) {
      const double budget =
          all.empty() ? 5 : all.front() + share * (all.back() - all.front()) + 0.1;
      const auto within =
          static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), budget) - all.begin());
      for (const std::size_t k : {std::size_t{1}, std::size_t{7}, all.size() + 1}) {
        for (const double leaf_work : {0.0, 1e6}) {
          PackingBuffer known(k);
          const TreeRanking tree = rank_by_tree(
              instance.component, instance.slack, budget, margin, {}, known, leaf_work);
          ASSERT_TRUE(tree.complete);
          branched += tree.nodes > 1;
          const std::vector<core::Packing> packings = known.take();
          ASSERT_GE(packings.size(), std::min(k, within));
          std::set<std::vector<core::ArcId>> different;
          for (std::size_t r = 0; r < packings.size(); ++r) {
            const core::Packing& packing = packings[r];
            ASSERT_EQ(packing.cost, slack_of_packing(instance.slack, packing.arcs));
            core::Packing costed = core::make_packing(instance.component, packing.arcs);
            ASSERT_EQ(support::packing_fault(instance.component, costed), "");
            ASSERT_TRUE(different.insert(packing.arcs).second);
            if (r < within) {
              ASSERT_NEAR(packing.cost, all[r], 1e-9);
            }
          }
        }
      }
    }
  }
  EXPECT_GT(branched, 400);
}

// Wherever that happens: what claims to be complete is.
TEST(RankByTree, SaysWhereTheClockStoppedIt) {
  int stopped = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = random_instance(seed);
    const std::vector<double> all = all_slacks(instance);
    if (all.empty() || all.size() > 60) continue;
    bool has_struck = true;
    for (int strike = 1; has_struck; strike += 1 + strike / 8) {
      const CountedClock clock([&](int look) { return look == strike; });
      bnb::SlackLimits limits;
      limits.deadline = clock.deadline();
      PackingBuffer known(all.size());
      const TreeRanking tree =
          rank_by_tree(instance.component, instance.slack, 1e3, 0, limits, known);
      has_struck = clock.has_struck();
      stopped += !tree.complete;
      if (tree.complete) {
        EXPECT_EQ(known.size(), all.size());
      }
    }
  }
  EXPECT_GT(stopped, 100);
}

TEST(RankByTree, SaysWhereALimitStoppedIt) {
  const Instance instance = random_instance(1);
  for (const double leaf_work : {0.0, 1e6}) {
    bnb::SlackLimits limits;
    limits.max_nodes = 1;
    PackingBuffer known(100);
    EXPECT_FALSE(rank_by_tree(instance.component, instance.slack, 1e3, 0, limits, known, leaf_work)
                     .complete);
  }
  bnb::SlackLimits limits;
  limits.max_work = 1;
  PackingBuffer known(100);
  EXPECT_FALSE(rank_by_tree(instance.component, instance.slack, 1e3, 0, limits, known, 0).complete);
}

}  // namespace
}  // namespace nda::kbest
