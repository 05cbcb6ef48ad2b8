#include "recovery/dimensionwise_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "recovery/greedy.hpp"
#include "support/components.hpp"

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using ::testing::ElementsAre;

constexpr double kTie = 1e-9;

// Sizes 2..4 in three to five dimensions, a quarter to most of all tuples.
Component dense_component(std::uint64_t seed) {
  core::Random random(seed);
  support::RandomComponentOptions options;
  options.sizes.clear();
  int tuples = 1;
  for (std::uint64_t k = 3 + random.below(3); k > 0; --k) {
    options.sizes.push_back(static_cast<Index>(2 + random.below(k > 3 ? 1 : 3)));
    tuples *= static_cast<int>(options.sizes.back()) + 1;
  }
  options.num_arcs = tuples / static_cast<int>(1 + random.below(3));
  options.dummy_share = seed % 3 == 0 ? 0 : 0.25;
  options.integer = seed % 2 == 0;
  return support::random_component(seed, options);
}

using Part = std::vector<Index>;  // a tuple with dummies for the other set

// The parts that a cut makes of a packing and its uncovered indices.
std::set<Part> parts_of(const Component& component,
                        const Packing& packing,
                        unsigned cut,
                        unsigned side) {
  std::set<Part> parts;
  const Part none(component.sizes.size(), 0);
  std::set<std::uint32_t> covered;
  const auto belongs = [&](std::size_t k) { return (cut >> k & 1) == side; };
  for (const ArcId a : packing.arcs) {
    Part part = none;
    for (std::size_t k = 0; k < part.size(); ++k) {
      covered.insert(component.slot(static_cast<int>(k), a));
      if (belongs(k)) part[k] = component.index(static_cast<int>(k), a);
    }
    if (part != none) parts.insert(part);
  }
  for (std::size_t k = 0; k < none.size(); ++k) {
    for (Index i = 1; i <= component.sizes[k]; ++i) {
      if (!belongs(k) || covered.count(component.offset[k] + i) > 0) continue;
      Part part = none;
      part[k] = i;
      parts.insert(part);
    }
  }
  return parts;
}

// The best packing of one cut by enumeration: of all packings of arcs that consist of at most one
// whole part of either set.
double best_of_cut(const Component& component, const Packing& packing, unsigned cut) {
  std::set<Part> sides[2] = {parts_of(component, packing, cut, 0),
                             parts_of(component, packing, cut, 1)};
  Component glued = core::make_component(component.sizes);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    Part tuple(component.sizes.size(), 0);
    Part part[2] = {tuple, tuple};
    for (std::size_t k = 0; k < tuple.size(); ++k)
      part[cut >> k & 1][k] = tuple[k] = component.index(static_cast<int>(k), a);
    const Part none(tuple.size(), 0);
    const bool is_glued = (part[0] == none || sides[0].count(part[0]) > 0) &&
                          (part[1] == none || sides[1].count(part[1]) > 0);
    if (is_glued) core::append_arc(glued, tuple, component.costs[a]);
  }
  return std::min(0.0, support::best_cost(glued));
}

TEST(DimensionwiseSearch, SuitsComponentsWithAGoodPartOfAllTuples) {
  support::RandomComponentOptions options;
  options.sizes = {9, 9, 9};
  options.num_arcs = 100;
  EXPECT_FALSE(DimensionwiseSearch::suits(support::random_component(1, options)));
  options.num_arcs = 150;
  EXPECT_TRUE(DimensionwiseSearch::suits(support::random_component(1, options)));
  options.sizes = {9, 9};
  EXPECT_FALSE(DimensionwiseSearch::suits(support::random_component(1, options)));
}

// Two indices in each of three dimensions.  The packing (1,1,1) (2,2,2) costs -2.  Reassigning the
// indices of any one dimension gives tuples that exist only for the last: (1,1,2) (2,2,1) cost -10.
TEST(DimensionwiseSearch, ReassignsTheIndicesOfADimension) {
  Component component = core::make_component({2, 2, 2});
  core::append_arc(component, std::vector<Index>{1, 1, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 1, 2}, -3);
  core::append_arc(component, std::vector<Index>{2, 2, 1}, -7);
  core::append_arc(component, std::vector<Index>{2, 2, 2}, -1);
  DimensionwiseSearch search(component, {});
  Packing packing = core::make_packing(component, {0, 3});
  EXPECT_GT(search.descend(packing), 0);
  EXPECT_THAT(packing.arcs, ElementsAre(1, 2));
  EXPECT_EQ(packing.cost, -10);
}

TEST(DimensionwiseSearch, CoversUncoveredIndicesByTheirTuples) {
  Component component = core::make_component({2, 2, 2});
  core::append_arc(component, std::vector<Index>{1, 1, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 2, 2}, -1);
  core::append_arc(component, std::vector<Index>{2, 1, 1}, -1);
  core::append_arc(component, std::vector<Index>{2, 2, 2}, -2);
  DimensionwiseSearch search(component, {});
  Packing packing;
  search.descend(packing);
  EXPECT_EQ(packing.cost, -3);
}

TEST(DimensionwiseSearch, EndsInAPackingThatNoCutImprovesAndNeverADearerOne) {
  int num_better = 0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = dense_component(seed);
    if (!DimensionwiseSearch::suits(component)) continue;
    core::Random random(seed);
    std::vector<double> key(component.num_arcs());
    for (double& value : key) value = random.uniform();
    const Packing start = seed % 5 == 0 ? Packing{} : greedy(component, key);
    Packing packing = start;
    DimensionwiseSearch search(component, {});
    search.descend(packing);
    EXPECT_EQ(support::packing_fault(component, packing), "");
    EXPECT_LE(packing.cost, start.cost);
    num_better += packing.cost < start.cost - kTie;
    for (unsigned cut = 2; cut < 1u << component.num_dimensions(); cut += 2)
      EXPECT_GE(best_of_cut(component, packing, cut), packing.cost - 1e-6) << "cut " << cut;
  }
  EXPECT_GT(num_better, 1000);
}

// In three dimensions of two indices all is one move away.
TEST(DimensionwiseSearch, MakesTheBestMoveOfItsCuts) {
  int num_optimal = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomComponentOptions options;
    options.sizes = {2, 2, 2};
    options.num_arcs = 60;
    options.dummy_share = 0;
    options.positive_share = 0;
    const Component component = support::random_component(seed, options);
    if (component.num_arcs() < 8) continue;
    Packing packing = core::make_packing(component, {0, 7});
    DimensionwiseSearch(component, {}).descend(packing);
    EXPECT_NEAR(packing.cost, support::best_cost(component), kTie);
    ++num_optimal;
  }
  EXPECT_GT(num_optimal, 100);
}

TEST(DimensionwiseSearch, ImprovesByShufflingTheSameWayForTheSameSeed) {
  int num_better = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    support::RandomComponentOptions options;
    options.sizes = {6, 6, 6};
    options.num_arcs = 600;
    options.dummy_share = 0;
    const Component component = support::random_component(seed, options);
    DimensionwiseSearch search(component, {});
    Packing descended = greedy(component, component.costs);
    search.descend(descended);
    core::Random random(seed);
    Packing packing = greedy(component, component.costs);
    EXPECT_GE(search.improve(packing, 1e5, -kInfinity, random), 1e5);
    EXPECT_EQ(support::packing_fault(component, packing), "");
    EXPECT_LE(packing.cost, descended.cost + kTie);
    num_better += packing.cost < descended.cost - kTie;
    core::Random again(seed);
    Packing same = greedy(component, component.costs);
    DimensionwiseSearch(component, {}).improve(same, 1e5, -kInfinity, again);
    EXPECT_EQ(same.arcs, packing.arcs);
    core::Random unused(seed);
    EXPECT_LT(search.improve(packing, 1e9, packing.cost, unused), 1e5);
  }
  EXPECT_GT(num_better, 25);
}

TEST(DimensionwiseSearch, DoesNothingAfterTheDeadline) {
  const Component component = dense_component(6);
  Packing packing = greedy(component, component.costs);
  const Packing before = packing;
  core::Random random(1);
  DimensionwiseSearch search(component, core::Deadline(0));
  search.improve(packing, 1e9, -kInfinity, random);
  EXPECT_EQ(packing.arcs, before.arcs);
}

}  // namespace
}  // namespace nda::recovery
