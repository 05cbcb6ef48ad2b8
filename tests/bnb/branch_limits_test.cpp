#include <gtest/gtest.h>

#include "bnb/branch_and_bound.hpp"
#include "bnb/fakes.hpp"

// What a collaborator may rely on, and what the limits mean.

namespace nda::bnb {
namespace {

using core::ArcId;
using core::Component;
using core::Packing;
using support::sum_of;

using Bound = std::function<NodeBound(const Component&, std::span<const double>, double)>;
using Reduce = std::function<Reduction(const Component&, const NodeBound&, double)>;

// Two arcs in conflict at -5 and -4, u = -5 on the index they share.
Component two_rivals() {
  Component component = core::make_component({1, 2});
  core::append_arc(component, std::vector<Index>{1, 1}, -5);
  core::append_arc(component, std::vector<Index>{1, 2}, -4);
  return component;
}
const std::vector<double> kRivalMultipliers = {0, -5, 0, 0, 0};

// Below -4.5 the second arc is too dear, and the first is all that is left for the index they
// share.
TEST(BranchAndBoundContract, CountsWhatIsFixedAtItsNodes) {
  const SearchResult result = branch_and_bound(two_rivals(),
                                               kRivalMultipliers,
                                               -4.5,
                                               {keep_the_warm_multipliers, fix_and_split},
                                               branch_always());
  EXPECT_EQ(result.best.cost, -5);
  EXPECT_EQ(result.branching.dropped, 1);
  EXPECT_EQ(result.branching.taken, 1);
  EXPECT_EQ(result.branching.splits, 0);
}

// The same twice.
TEST(BranchAndBoundContract, CountsThePartsOfItsNodes) {
  Component component = core::make_component({2, 4});
  for (const Index i : {1u, 2u}) {
    core::append_arc(component, std::vector<Index>{i, 2 * i - 1}, -5);
    core::append_arc(component, std::vector<Index>{i, 2 * i}, -4);
  }
  const std::vector<double> u = {0, -5, -5, 0, 0, 0, 0, 0};
  const SearchResult result = branch_and_bound(
      component, u, kInfinity, {keep_the_warm_multipliers, split_only}, branch_always());
  EXPECT_EQ(result.best.cost, -10);
  EXPECT_EQ(result.branching.dropped, 0);
  EXPECT_EQ(result.branching.taken, 0);
  EXPECT_EQ(result.branching.splits, 1);
  EXPECT_EQ(result.branching.parts, 2);
}

TEST(BranchAndBoundContract, FindsNothingThatIsNotBetterByTheMargin) {
  BranchLimits limits = branch_always();
  limits.margin = 1.5;
  const Bound offer_the_second = [](const Component& node, std::span<const double> warm, double c) {
    NodeBound bound = keep_the_warm_multipliers(node, warm, c);
    if (node.num_arcs() == 2) bound.packing = {{1}, -4};
    return bound;
  };
  const SearchResult result = branch_and_bound(
      two_rivals(), kRivalMultipliers, kInfinity, {offer_the_second, split_only}, limits);
  EXPECT_EQ(result.best.cost, -4) << "-5 is better by 1 only";
  EXPECT_TRUE(result.complete);
  limits.margin = kTie;
  limits.gap = 1.5;
  const SearchResult near = branch_and_bound(
      two_rivals(), kRivalMultipliers, kInfinity, {offer_the_second, split_only}, limits);
  EXPECT_EQ(near.best.cost, -4);
  EXPECT_NEAR(near.lower, -5.5, kTie);
}

TEST(BranchAndBoundContract, PassesTheCutoffLessTheMarginToTheBound) {
  BranchLimits limits = branch_always();
  limits.margin = limits.error = 0.25;
  std::vector<double> cutoffs;
  const Bound record = [&](const Component& node, std::span<const double> warm, double cutoff) {
    cutoffs.push_back(cutoff);
    return keep_the_warm_multipliers(node, warm, cutoff);
  };
  branch_and_bound(two_rivals(), kRivalMultipliers, -1, {record, split_only}, limits);
  ASSERT_FALSE(cutoffs.empty());
  EXPECT_EQ(cutoffs.front(), -1);
}

TEST(BranchAndBoundContract, LooksNoFurtherOnceTheBoundReachesTheCutoff) {
  int num_reductions = 0;
  const Reduce count = [&](const Component& node, const NodeBound& bound, double cutoff) {
    ++num_reductions;
    return split_only(node, bound, cutoff);
  };
  const SearchResult result = branch_and_bound(
      two_rivals(), kRivalMultipliers, -5, {keep_the_warm_multipliers, count}, branch_always());
  EXPECT_TRUE(result.complete);
  EXPECT_FALSE(result.found);
  EXPECT_EQ(num_reductions, 0);
  EXPECT_GE(result.lower, -5);
}

TEST(BranchAndBoundContract, EnumeratesSmallParts) {
  int num_bounds = 0;
  const Bound count = [&](const Component& node, std::span<const double> warm, double cutoff) {
    ++num_bounds;
    return keep_the_warm_multipliers(node, warm, cutoff);
  };
  const SearchResult result = branch_and_bound(
      two_rivals(), kRivalMultipliers, kInfinity, {count, split_only}, BranchLimits{});
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.best.cost, -5);
  EXPECT_EQ(num_bounds, 0);
  EXPECT_GT(result.nodes, 0);
}

TEST(BranchAndBoundContract, BoundsAgainWhatTakesTooLongToEnumerate) {
  int num_bounds = 0;
  const Bound count = [&](const Component& node, std::span<const double> warm, double cutoff) {
    ++num_bounds;
    return keep_the_warm_multipliers(node, warm, cutoff);
  };
  BranchLimits limits;
  limits.enumeration_nodes = 1;
  const SearchResult result =
      branch_and_bound(two_rivals(), kRivalMultipliers, kInfinity, {count, split_only}, limits);
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.best.cost, -5);
  EXPECT_GT(num_bounds, 0);
}

TEST(BranchAndBoundContract, BoundsNoMoreNodesThanAllowed) {
  support::RandomComponentOptions options;
  options.sizes = {6, 6, 6};
  options.num_arcs = 40;
  const Component component = support::random_component(11, options);
  core::Random random(1);
  const std::vector<double> u = support::feasible_multipliers(component, random, 1);
  for (const std::int64_t max_nodes : {0, 1, 2, 10}) {
    SCOPED_TRACE(max_nodes);
    BranchLimits limits = branch_always();
    limits.max_nodes = max_nodes;
    std::int64_t num_bounds = 0;
    const Bound count = [&](const Component& node, std::span<const double> warm, double cutoff) {
      ++num_bounds;
      return keep_the_warm_multipliers(node, warm, cutoff);
    };
    const SearchResult result =
        branch_and_bound(component, u, kInfinity, {count, split_only}, limits);
    EXPECT_LE(num_bounds, max_nodes);
    EXPECT_FALSE(result.complete);
    EXPECT_LE(result.lower, support::best_cost(component) + kTie);
    EXPECT_GE(result.lower, sum_of(u) - kTie) << "the multipliers alone prove that";
  }
}

TEST(BranchAndBoundContract, OfNoArcsFindsTheEmptyPackingBelowThePositiveCutoff) {
  const Component none = core::make_component({});
  const Collaborators fakes{keep_the_warm_multipliers, split_only};
  const SearchResult found = branch_and_bound(none, {}, 1, fakes, branch_always());
  EXPECT_TRUE(found.complete && found.found);
  EXPECT_EQ(found.best.cost, 0);
  EXPECT_LE(found.lower, 0);
  const SearchResult nothing = branch_and_bound(none, {}, -1, fakes, branch_always());
  EXPECT_TRUE(nothing.complete && !nothing.found);
}

}  // namespace
}  // namespace nda::bnb
