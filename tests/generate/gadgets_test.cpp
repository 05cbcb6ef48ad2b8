#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "nda/generate.hpp"
#include "support/brute_force.hpp"

namespace nda {
namespace {

TEST(Gadgets, HaveTheOptimumTheyState) {
  GadgetsOptions options;
  options.gadgets = 2;
  for (options.seed = 1; options.seed <= 60; ++options.seed) {
    SCOPED_TRACE(options.seed);
    options.dimensions = 3 + static_cast<int>(options.seed % 4);
    options.size = 1 + static_cast<Index>(options.seed % 3);
    const Instance instance = generate_gadgets(options);
    EXPECT_DOUBLE_EQ(support::brute_force(instance.problem)->cost, *instance.optimum);
  }
}

// Least cost when every arc may be taken in halves, by plain recursion.
double half_integral(const Problem& problem,
                     std::size_t a,
                     std::map<std::pair<int, Index>, int>& halves) {
  if (a == problem.num_arcs()) return 0;
  double best = kInfinity;
  for (int h = 0; h <= 2; ++h) {
    bool fits = true;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      const Index i = problem.indices(k)[a];
      if (i != 0) fits &= (halves[{k, i}] += h) <= 2;
    }
    if (fits)
      best = std::min(best, h * problem.costs()[a] / 2 + half_integral(problem, a + 1, halves));
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      const Index i = problem.indices(k)[a];
      if (i != 0) halves[{k, i}] -= h;
    }
  }
  return best;
}

TEST(Gadgets, HaveAnIntegralityGap) {
  GadgetsOptions options;
  options.gadgets = 1;
  for (options.seed = 1; options.seed <= 20; ++options.seed) {
    SCOPED_TRACE(options.seed);
    const Instance instance = generate_gadgets(options);
    std::map<std::pair<int, Index>, int> halves;
    const double half = half_integral(instance.problem, 0, halves);
    EXPECT_LT(half, *instance.optimum);
    const std::string& comment = instance.comments[2];  // "LP value at most X (half-integral)"
    EXPECT_DOUBLE_EQ(std::stod(comment.substr(comment.find("most ") + 5)), half);
  }
}

TEST(Gadgets, AreDisjoint) {
  GadgetsOptions options;
  options.gadgets = 30;
  const Problem problem = generate_gadgets(options).problem;
  EXPECT_EQ(problem.size(0), 60u);
  EXPECT_GT(problem.num_arcs(), 200u);
  EXPECT_LE(problem.num_arcs(), 300u);
  // Two indices of a dimension at most meet any set of arcs joined by common indices.
  std::vector<std::set<std::pair<int, Index>>> parts;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    std::set<std::pair<int, Index>> joined;
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      if (problem.indices(k)[a] != 0) joined.insert({k, problem.indices(k)[a]});
    }
    std::vector<std::set<std::pair<int, Index>>> apart;
    for (const auto& part : parts) {
      const bool meets = std::any_of(
          part.begin(), part.end(), [&](const auto& index) { return joined.count(index) > 0; });
      if (meets) {
        joined.insert(part.begin(), part.end());
      } else {
        apart.push_back(part);
      }
    }
    apart.push_back(joined);
    parts = std::move(apart);
  }
  EXPECT_GE(parts.size(), 30u);
  for (const auto& part : parts) EXPECT_LE(part.size(), 8u);
}

TEST(Gadgets, GiveUpWhereAllArcsShareAnIndex) {
  GadgetsOptions options;
  options.dimensions = 64;
  options.size = 1;
  options.arcs_per_gadget = 3;
  EXPECT_THROW(generate_gadgets(options), InputError);
}

TEST(Gadgets, RejectOptionsOutOfRange) {
  GadgetsOptions options;
  options.dimensions = 2;
  EXPECT_THROW(generate_gadgets(options), InputError);
  options = {};
  options.arcs_per_gadget = 15;
  EXPECT_THROW(generate_gadgets(options), InputError);
}

}  // namespace
}  // namespace nda
