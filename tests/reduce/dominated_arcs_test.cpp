#include "reduce/dominated_arcs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reduce/reduce_support.hpp"
#include "reduce/redundant_indices.hpp"

namespace nda::reduce {
namespace {

using ::testing::ElementsAre;

std::vector<core::ArcId> left_of(const core::Component& component) {
  ArcPool pool;
  pool.reset(component);
  const std::size_t before = pool.num_alive();
  const std::size_t dropped = drop_dominated_arcs(pool);
  EXPECT_EQ(dropped, before - pool.num_alive());
  return arcs_alive(pool);
}

TEST(DominatedArcs, GoWhereAShorterArcCostsNoMore) {
  const auto left = left_of(make({2, 2, 2}, {{{1, 1, 0}, -4}, {{1, 1, 1}, -4}, {{1, 1, 2}, -4.5}}));
  EXPECT_THAT(left, ElementsAre(0, 2));
}

TEST(DominatedArcs, GoWhereTwoShorterArcsCostNoMoreTogether) {
  const auto four = [](double cost) {
    return make({1, 1, 1, 1}, {{{0, 0, 1, 1}, -2}, {{1, 1, 0, 0}, -3}, {{1, 1, 1, 1}, cost}});
  };
  EXPECT_THAT(left_of(four(-5)), ElementsAre(0, 1));
  EXPECT_THAT(left_of(four(-5.1)), ElementsAre(0, 1, 2));
}

TEST(DominatedArcs, GoWhereThreeShorterArcsCostNoMoreTogether) {
  const auto six = [](double cost) {
    return make({1, 1, 1, 1, 1, 1},
                {{{0, 0, 0, 0, 1, 1}, -2},
                 {{0, 0, 1, 1, 0, 0}, -2},
                 {{0, 1, 1, 0, 0, 0}, -3.5},
                 {{1, 1, 0, 0, 0, 0}, -2},
                 {{1, 1, 1, 1, 1, 1}, cost}});
  };
  EXPECT_THAT(left_of(six(-6)), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(left_of(six(-6.1)), ElementsAre(0, 1, 2, 3, 4));
}

TEST(DominatedArcs, AreTheDearerOfThoseThatShowTheSameIndices) {
  ArcPool pool;
  pool.reset(make({1, 1, 2}, {{{1, 1, 0}, -1}, {{1, 1, 1}, -3}, {{1, 1, 2}, -2}}));
  pool.relieve(5);
  pool.relieve(6);
  EXPECT_EQ(drop_dominated_arcs(pool), 2);
  EXPECT_THAT(arcs_alive(pool), ElementsAre(1));
}

TEST(DominatedArcs, StayWhereTheyAreTooLongToLookInto) {
  core::Component component = core::make_component(std::vector<Index>(9, 1));
  std::vector<Index> tuple(9, 1);
  tuple[8] = 0;
  core::append_arc(component, tuple, -2);
  tuple[8] = 1;
  core::append_arc(component, tuple, -1);
  EXPECT_THAT(left_of(component), ElementsAre(0, 1));
}

TEST(DominatedArcs, AreMissedByNoBestPackingAndNoMultipliers) {
  EXPECT_GT(times_equivalent([](ArcPool& pool, std::uint64_t seed) {
              if (seed % 3 == 0) relieve_redundant_indices(pool);
              return drop_dominated_arcs(pool) > 0;
            }),
            500);
}

// By definition: every arc is compared with all packings of the others within its indices.
TEST(DominatedArcs, AreAllThereAre) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const core::Component component = reducible_component(seed);
    const std::vector<core::ArcId> left = left_of(component);
    const std::vector<core::Packing> packings = support::all_packings(component);
    for (const core::ArcId a : left) {
      std::vector<std::uint32_t> own;
      core::for_each_slot(component, a, [&](std::uint32_t slot) { own.push_back(slot); });
      for (const core::Packing& packing : packings) {
        bool within = packing.arcs != std::vector{a};
        for (const core::ArcId b : packing.arcs) {
          core::for_each_slot(component, b, [&](std::uint32_t slot) {
            within = within && std::count(own.begin(), own.end(), slot) > 0;
          });
        }
        if (within) {
          EXPECT_GT(packing.cost, component.costs[a] - 1e-12);
        }
      }
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace nda::reduce
