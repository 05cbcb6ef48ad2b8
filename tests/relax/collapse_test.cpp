#include "relax/collapse.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>

#include "support/components.hpp"

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Cells, AreRunsOfEqualFirstTwoIndices) {
  Component component = core::make_component({2, 2, 2});
  for (const std::vector<Index>& tuple :
       {std::vector<Index>{0, 1, 1}, {0, 1, 2}, {1, 0, 1}, {1, 1, 0}, {1, 1, 2}, {2, 1, 1}}) {
    core::append_arc(component, tuple, -1);
  }
  const Cells cells = find_cells(component);
  EXPECT_EQ(cells.num_cells(), 4u);
  EXPECT_THAT(cells.row, ElementsAre(0, 1, 1, 2));
  EXPECT_THAT(cells.column, ElementsAre(1, 0, 1, 1));
  EXPECT_THAT(cells.first_arc, ElementsAre(0, 2, 3, 5, 6));
}

TEST(Cells, LeaveOutTheFreePair) {
  Component component = core::make_component({2, 2, 2});
  for (const std::vector<Index>& tuple : {std::vector<Index>{0, 0, 1}, {0, 0, 2}, {0, 1, 1}}) {
    core::append_arc(component, tuple, -1);
  }
  const Cells cells = find_cells(component);
  EXPECT_EQ(cells.num_free(), 2u);
  EXPECT_THAT(cells.row, ElementsAre(0));
  EXPECT_THAT(cells.column, ElementsAre(1));
  EXPECT_THAT(cells.first_arc, ElementsAre(2, 3));
}

TEST(Cells, OfNoArcsAreNone) {
  const Cells cells = find_cells(core::make_component({1, 1}));
  EXPECT_EQ(cells.num_cells(), 0u);
  EXPECT_THAT(cells.first_arc, ElementsAre(0));
}

// Of all cells.
std::vector<ArcId> cheapest_arcs(const Component& component, std::span<const double> u) {
  const Cells cells = find_cells(component);
  std::vector<double> d(cells.num_cells());
  std::vector<ArcId> from(cells.num_cells());
  collapse(component, cells, u, d, from);
  std::vector<std::uint32_t> wanted(cells.num_cells());
  std::iota(wanted.begin(), wanted.end(), 0u);
  std::vector<ArcId> found;
  for (CheapestArcs arcs(component, cells, u, d, from, wanted); !arcs.done();) {
    found.push_back(arcs.next());
  }
  return found;
}

TEST(Collapse, TakesTheFirstOfEqualArcs) {
  Component component = core::make_component({1, 1, 3});
  core::append_arc(component, std::vector<Index>{1, 1, 1}, -1);
  core::append_arc(component, std::vector<Index>{1, 1, 2}, -3);
  core::append_arc(component, std::vector<Index>{1, 1, 3}, -3);
  const Cells cells = find_cells(component);
  std::vector<double> u(component.num_slots(), 0.0);
  std::vector<double> d(1);
  std::vector<ArcId> from(1);
  collapse(component, cells, u, d, from);
  EXPECT_EQ(d[0], -3);
  EXPECT_THAT(cheapest_arcs(component, u), ElementsAre(1));
  u[component.offset[2] + 1] = 2;  // -1 - 2: a tie of all three
  collapse(component, cells, u, d, from);
  EXPECT_EQ(d[0], -3);
  EXPECT_THAT(cheapest_arcs(component, u), ElementsAre(0));
}

// Dense over (row, column): cheapest reduced cost and first arc of every pair, by three loops.  To
// the bit, whatever the way: subtractions are in the order of dimensions.
void expect_naive(const Component& component, std::span<const double> u) {
  const Cells cells = find_cells(component);
  std::vector<double> d(cells.num_cells());
  std::vector<ArcId> from(cells.num_cells());
  collapse(component, cells, u, d, from);
  const std::vector<ArcId> found = cheapest_arcs(component, u);
  std::uint32_t cell = 0;
  for (Index i = 0; i <= component.sizes[0]; ++i) {
    for (Index j = i == 0 ? 1 : 0; j <= component.sizes[1]; ++j) {
      double best = kInfinity;
      ArcId best_arc = 0;
      for (ArcId a = 0; a < component.num_arcs(); ++a) {
        if (component.index(0, a) != i || component.index(1, a) != j) continue;
        double reduced = component.costs[a];
        for (int k = 2; k < component.num_dimensions(); ++k) reduced -= u[component.slot(k, a)];
        if (reduced >= best) continue;
        best = reduced;
        best_arc = a;
      }
      if (best == kInfinity) continue;
      ASSERT_LT(cell, cells.num_cells());
      EXPECT_EQ(cells.row[cell], i);
      EXPECT_EQ(cells.column[cell], j);
      EXPECT_EQ(d[cell], best);
      EXPECT_EQ(found[cell], best_arc);
      ++cell;
    }
  }
  EXPECT_EQ(cell, cells.num_cells());
}

// Those of dimensions 0 and 1 must be ignored: they are not 0 here.
std::vector<double> random_multipliers(const Component& component, core::Random& random) {
  std::vector<double> u(component.num_slots());
  for (double& multiplier : u) multiplier = random.uniform(-5, 5);
  for (const std::uint32_t dummy : component.offset) u[dummy] = 0;
  return u;
}

// One kernel for each number of dimensions.
class CollapseKernels : public ::testing::TestWithParam<int> {};

TEST_P(CollapseKernels, AgreeWithANaiveTripleLoop) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    support::RandomComponentOptions options;
    options.sizes.clear();
    for (int k = 0; k < GetParam(); ++k) {
      options.sizes.push_back(1 + static_cast<Index>(random.below(4)));
    }
    options.num_arcs = 1 + static_cast<int>(random.below(80));
    const Component component = support::random_component(seed, options);
    expect_naive(component, random_multipliers(component, random));
  }
}

// Two rows and two columns of hundreds of arcs: cells long enough to be taken one by one, by runs
// too where the third dimension has few indices, and several blocks of reduced costs.
TEST_P(CollapseKernels, AgreeOnLongCells) {
  bool by_cells = false;
  bool by_runs = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    support::RandomComponentOptions options;
    options.sizes.assign(static_cast<std::size_t>(GetParam()), 12);
    options.sizes[0] = options.sizes[1] = 2;
    if (seed % 2 == 0 && GetParam() > 2) options.sizes[2] = 1;
    options.sizes.back() = 500;
    options.num_arcs = 1200;
    const Component component = support::random_component(seed, options);
    const Cells cells = find_cells(component);
    by_cells = by_cells || (cells.begins_cell.empty() && cells.run_index.empty());
    by_runs = by_runs || !cells.run_index.empty();
    expect_naive(component, random_multipliers(component, random));
  }
  EXPECT_EQ(by_cells, GetParam() > 2);
  EXPECT_EQ(by_runs, GetParam() > 3);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CollapseKernels, ::testing::Range(2, 11));

}  // namespace
}  // namespace nda::relax
