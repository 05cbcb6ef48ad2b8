#include "decompose/components.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "support/brute_force.hpp"
#include "support/components.hpp"
#include "support/random_problems.hpp"
#include "support/tiny_problems.hpp"

namespace nda::decompose {
namespace {

using core::ArcId;
using core::Component;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Groups = std::vector<std::vector<ArcId>>;
using Tuple = std::vector<Index>;

bool touch(const Tuple& a, const Tuple& b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] != 0 && a[k] == b[k]) return true;
  }
  return false;
}

// Breadth-first search from arc to arc that shares an index, starting at the smallest arc left:
// groups come in the order of their smallest arc, each ascending.
Groups naive_groups(const std::vector<Tuple>& tuples, const std::vector<bool>& counts) {
  Groups groups;
  std::vector<bool> seen(tuples.size(), false);
  for (ArcId first = 0; first < tuples.size(); ++first) {
    if (seen[first] || !counts[first]) continue;
    std::vector<ArcId> queue = {first};
    seen[first] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
      for (ArcId b = 0; b < tuples.size(); ++b) {
        if (seen[b] || !counts[b] || !touch(tuples[queue[next]], tuples[b])) continue;
        seen[b] = true;
        queue.push_back(b);
      }
    }
    std::sort(queue.begin(), queue.end());
    groups.push_back(std::move(queue));
  }
  return groups;
}

Groups groups_of(const Partition& partition) {
  Groups groups;
  for (std::size_t c = 0; c < partition.num_components(); ++c) {
    groups.emplace_back(partition.component(c).begin(), partition.component(c).end());
  }
  return groups;
}

TEST(Partition, OfNothingHasNoComponents) {
  EXPECT_EQ(Partition().num_components(), 0u);
  const Partition none = partition(core::make_component({2, 2}));
  EXPECT_EQ(none.num_components(), 0u);
  EXPECT_THAT(none.arcs, IsEmpty());
  EXPECT_EQ(partition(core::make_component({})).num_components(), 0u);
}

TEST(Partition, SplitsTwoTracksThatShareNothing) {
  const Problem problem = support::two_components().problem;
  const Partition parts = partition(problem, core::make_shift(problem));
  // (0,2,2) (1,1,0) (1,1,1) (2,2,2)
  EXPECT_THAT(groups_of(parts), ElementsAre(ElementsAre(0, 3), ElementsAre(1, 2)));
  EXPECT_THAT(parts.start, ElementsAre(0, 2, 4));
}

TEST(Partition, DummiesDoNotConnect) {
  const Problem problem = support::make_problem({2, 2, 2}, {{{1, 1, 0}, -1}, {{2, 2, 0}, -1}});
  EXPECT_EQ(partition(problem, core::make_shift(problem)).num_components(), 2u);
}

TEST(Partition, EqualNumbersOfDifferentDimensionsDoNotConnect) {
  const Problem problem =
      support::make_problem({2, 2, 2, 2}, {{{1, 1, 0, 0}, -1}, {{0, 0, 1, 1}, -1}});
  EXPECT_EQ(partition(problem, core::make_shift(problem)).num_components(), 2u);
}

TEST(Partition, LeavesOutArcsThatCannotImproveOnTheirSingletons) {
  // Singletons 1: two real indices refund 2, three 3.  (2,1,0) and (0,2,2) would connect all.
  const Problem problem = support::make_problem(
      {2, 2, 2},
      {{{1, 1, 1}, 2.5}, {{2, 1, 0}, 2}, {{2, 2, 0}, 1.5}, {{0, 2, 2}, 2.5}, {{2, 2, 2}, 2}},
      1);
  EXPECT_THAT(groups_of(partition(problem, core::make_shift(problem))),
              ElementsAre(ElementsAre(1), ElementsAre(3, 4)));
}

TEST(Partition, OfAComponentCountsAllArcs) {
  Component component = core::make_component({2, 2});
  core::append_arc(component, Tuple{1, 1}, -1);
  core::append_arc(component, Tuple{1, 2}, 7);
  core::append_arc(component, Tuple{2, 2}, 0);
  EXPECT_THAT(groups_of(partition(component)), ElementsAre(ElementsAre(0, 1, 2)));
}

TEST(Partition, OfAProblemAgreesWithBreadthFirstSearch) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const support::RandomCase random = support::random_case(seed);
    SCOPED_TRACE(random.description);
    const core::Shift shift = core::make_shift(random.problem);
    std::vector<Tuple> tuples;
    std::vector<bool> counts;
    for (std::size_t a = 0; a < random.problem.num_arcs(); ++a) {
      tuples.push_back(random.problem.arc(a));
      counts.push_back(core::shifted_cost(random.problem, shift, a) < 0);
    }
    EXPECT_EQ(groups_of(partition(random.problem, shift)), naive_groups(tuples, counts));
  }
}

TEST(Partition, OfAComponentAgreesWithBreadthFirstSearch) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = support::random_component_of_any_kind(seed);
    std::vector<Tuple> tuples;
    for (ArcId a = 0; a < component.num_arcs(); ++a) {
      tuples.emplace_back();
      for (int k = 0; k < component.num_dimensions(); ++k) {
        tuples.back().push_back(component.index(k, a));
      }
    }
    EXPECT_EQ(groups_of(partition(component)),
              naive_groups(tuples, std::vector<bool>(tuples.size(), true)));
  }
}

TEST(Partition, OptimaOfTheComponentsAddUpToTheOptimum) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    support::RandomProblemOptions options;
    options.sizes = {5, 5, 5};
    options.num_arcs = 11;
    options.singletons = support::SingletonKind::kPriced;
    options.sign = support::SignKind::kMixed;
    SCOPED_TRACE(seed);
    const Problem problem = support::random_problem(seed, options);
    const core::Shift shift = core::make_shift(problem);
    const Partition parts = partition(problem, shift);
    double cost = shift.constant;
    core::Cutter cutter;
    for (std::size_t c = 0; c < parts.num_components(); ++c) {
      cost += support::best_cost(cutter.cut(problem, shift, parts.component(c)));
    }
    EXPECT_NEAR(cost, support::brute_force(problem)->cost, 1e-9);
  }
}

TEST(Join, MakesOneComponentOfAllArcs) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const core::Component component = support::random_component_of_any_kind(seed);
    Partition whole = partition(component);
    join(whole);
    ASSERT_EQ(whole.num_components(), 1u);
    EXPECT_EQ(whole.arcs, core::all_arcs(component));
  }
  Partition none;
  join(none);
  EXPECT_EQ(none.num_components(), 0u);
}

}  // namespace
}  // namespace nda::decompose
