#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "nda/assign2d.hpp"

// Two-dimensional assignment with bounds, by network simplex.

namespace nda {
namespace {

struct Instance {
  std::vector<std::uint32_t> row_start = {0};
  std::vector<std::uint32_t> column;
  std::vector<double> cost;
  std::vector<double> row_outside;
  std::vector<double> column_outside;
  std::vector<UseBounds> row_bounds;
  std::vector<UseBounds> column_bounds;

  Assign2dProblem view() const {
    return {row_start, column, cost, row_outside, column_outside, row_bounds, column_bounds};
  }
};

Instance random_instance(std::uint64_t seed) {
  core::Random random(seed);
  Instance instance;
  const auto cost = [&](double low, double high) {
    const double x = random.uniform(low, high);
    return seed % 2 == 0 ? std::round(x) : x;
  };
  const auto add_side = [&](std::vector<double>& outside, std::vector<UseBounds>& bounds) {
    const std::size_t size = 1 + random.below(4);
    for (std::size_t i = 0; i < size; ++i) {
      const auto lo = static_cast<Index>(random.below(4));
      const bool is_open = random.below(4) == 0;
      bounds.push_back(
          {lo, is_open ? UseBounds::kUnlimited : lo + static_cast<Index>(random.below(3))});
      const double c = cost(-3, 6);
      outside.push_back(random.below(8) == 0 ? kInfinity : is_open ? std::abs(c) : c);
    }
  };
  add_side(instance.row_outside, instance.row_bounds);
  add_side(instance.column_outside, instance.column_bounds);
  for (std::size_t i = 0; i < instance.row_outside.size(); ++i) {
    for (std::uint32_t j = 0; j < instance.column_outside.size(); ++j) {
      if (random.below(3) == 0 || instance.cost.size() == 12) continue;
      instance.column.push_back(j);
      instance.cost.push_back(random.below(10) == 0 ? kInfinity : cost(-6, 6));
    }
    instance.row_start.push_back(static_cast<std::uint32_t>(instance.cost.size()));
  }
  return instance;
}

std::vector<std::uint32_t> rows_of(const Instance& instance) {
  std::vector<std::uint32_t> rows;
  for (std::uint32_t i = 0; i + 1 < instance.row_start.size(); ++i)
    rows.insert(rows.end(), instance.row_start[i + 1] - instance.row_start[i], i);
  return rows;
}

double outside_cost(UseBounds bounds, double single, Index uses) {
  if (uses > bounds.hi) return kInfinity;
  const Index wanted = single < 0 ? bounds.hi : bounds.lo;
  return uses < wanted ? single * (wanted - uses) : 0.0;
}

double cost_of(const Instance& instance, const std::vector<std::uint32_t>& pairs) {
  const std::vector<std::uint32_t> rows = rows_of(instance);
  std::vector<Index> row_uses(instance.row_outside.size(), 0);
  std::vector<Index> column_uses(instance.column_outside.size(), 0);
  double cost = 0;
  for (const std::uint32_t pair : pairs) {
    cost += instance.cost[pair];
    ++row_uses[rows[pair]];
    ++column_uses[instance.column[pair]];
  }
  for (std::size_t i = 0; i < row_uses.size(); ++i)
    cost += outside_cost(instance.row_bounds[i], instance.row_outside[i], row_uses[i]);
  for (std::size_t j = 0; j < column_uses.size(); ++j)
    cost += outside_cost(instance.column_bounds[j], instance.column_outside[j], column_uses[j]);
  return cost;
}

double least_cost(const Instance& instance) {
  double least = kInfinity;
  for (std::uint32_t bits = 0; bits < 1u << instance.cost.size(); ++bits) {
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t p = 0; p < instance.cost.size(); ++p) {
      if ((bits >> p & 1) != 0) pairs.push_back(p);
    }
    least = std::min(least, cost_of(instance, pairs));
  }
  return least;
}

double proven_by(const Instance& instance, const Assign2dResult& result) {
  const auto least_of = [](UseBounds bounds, double single, double dual) {
    double least = kInfinity;
    for (Index n = 0; n <= std::min(bounds.hi, Index{20}); ++n)
      least = std::min(least, outside_cost(bounds, single, n) + dual * n);
    return least;
  };
  double sum = 0;
  for (std::size_t i = 0; i < result.u.size(); ++i)
    sum += least_of(instance.row_bounds[i], instance.row_outside[i], result.u[i]);
  for (std::size_t j = 0; j < result.v.size(); ++j)
    sum += least_of(instance.column_bounds[j], instance.column_outside[j], result.v[j]);
  const std::vector<std::uint32_t> rows = rows_of(instance);
  for (std::uint32_t p = 0; p < instance.cost.size(); ++p)
    sum += std::min(0.0, instance.cost[p] - result.u[rows[p]] - result.v[instance.column[p]]);
  return sum;
}

TEST(BoundedAssign2d, AgreesWithAllSubsets) {
  int infeasible = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Instance instance = random_instance(seed);
    const double least = least_cost(instance);
    const Assign2dResult result = assign2d(instance.view(), Assign2dMethod::kNetworkSimplex);
    EXPECT_EQ(result.feasible, least < kInfinity);
    infeasible += result.feasible ? 0 : 1;
    if (!result.feasible) continue;
    EXPECT_NEAR(result.cost, least, 1e-9);
    EXPECT_NEAR(cost_of(instance, result.pairs), least, 1e-9);
    EXPECT_NEAR(proven_by(instance, result), least, 1e-9);
    EXPECT_TRUE(result.column_of_row.empty());
  }
  EXPECT_GT(infeasible, 50);
  EXPECT_LT(infeasible, 900);
}

// Bounds of 1..1 are no bounds: every method takes them, and answers as without.
TEST(BoundedAssign2d, BoundsOfOneAreNone) {
  Instance instance = random_instance(3);
  instance.row_bounds.assign(instance.row_bounds.size(), {});
  instance.column_bounds.clear();
  for (const auto method :
       {Assign2dMethod::kShortestPath, Assign2dMethod::kAuction, Assign2dMethod::kNetworkSimplex}) {
    const Assign2dResult result = assign2d(instance.view(), method);
    EXPECT_EQ(result.column_of_row.size(), instance.row_outside.size());
    EXPECT_TRUE(result.pairs.empty());
  }
}

std::string fault_of(const Instance& instance, Assign2dMethod method) {
  try {
    assign2d(instance.view(), method);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(BoundedAssign2d, RefusesWhatItCannot) {
  Instance instance = random_instance(3);
  instance.row_bounds.front() = {0, 2};
  EXPECT_THAT(fault_of(instance, Assign2dMethod::kAuction),
              ::testing::HasSubstr("network simplex"));
  instance.row_bounds.front() = {3, 2};
  EXPECT_EQ(fault_of(instance, Assign2dMethod::kNetworkSimplex), "row_bounds[0] has lo above hi");
  instance.row_bounds.front() = {0, UseBounds::kUnlimited};
  instance.row_outside.front() = -1;
  EXPECT_THAT(fault_of(instance, Assign2dMethod::kNetworkSimplex),
              ::testing::HasSubstr("row_bounds[0] is unlimited"));
  instance.row_bounds.pop_back();
  EXPECT_THAT(fault_of(instance, Assign2dMethod::kNetworkSimplex), ::testing::HasSubstr("entries"));
}

}  // namespace
}  // namespace nda
