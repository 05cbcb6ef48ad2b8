#include "solve/monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solve/infeasibility.hpp"
#include "solve/process.hpp"
#include "support/tiny_problems.hpp"

namespace nda::pipeline {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Monitor, AddsUpWhatTheComponentsReport) {
  std::vector<Progress> seen;
  const std::function<bool(const Progress&)> callback = [&](const Progress& progress) {
    seen.push_back(progress);
    return true;
  };
  Monitor monitor(callback, 100, 2, 0, std::stop_source());
  monitor.add_component(-10);
  monitor.moved(-3, 0, "greedy");
  monitor.add_component(-20);
  monitor.moved(-1, 2, "recovery");
  monitor.component_done();
  monitor.moved(0, 5, "bound");
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_EQ(seen[0].cost, 97);
  EXPECT_EQ(seen[0].lower_bound, -kInfinity) << "the second component has no bound yet";
  EXPECT_STREQ(seen[0].event, "greedy");
  EXPECT_EQ(seen[0].num_components, 2u);
  EXPECT_EQ(seen[1].cost, 96);
  EXPECT_EQ(seen[1].lower_bound, 100 - 10 - 20 + 2);
  EXPECT_EQ(seen[1].components_done, 0u);
  EXPECT_EQ(seen[2].lower_bound, 77);
  EXPECT_EQ(seen[2].components_done, 1u);
  EXPECT_STREQ(seen[2].event, "bound");
  EXPECT_GE(seen[2].seconds, seen[0].seconds);
}

TEST(Monitor, AsksToStopWhenTheCallbackSaysSo) {
  std::stop_source stop;
  int calls = 0;
  const std::function<bool(const Progress&)> callback = [&](const Progress&) {
    return ++calls < 2;
  };
  Monitor monitor(callback, 0, 1, 0, stop);
  monitor.moved(-1, 0, "greedy");
  EXPECT_FALSE(stop.stop_requested());
  monitor.moved(-1, 0, "greedy");
  EXPECT_TRUE(stop.stop_requested());
  monitor.moved(-1, 0, "greedy");
  EXPECT_EQ(calls, 2) << "it has said all it has to say";
}

TEST(Monitor, KnowsNoCostBeforeAllComponentsAreFeasible) {
  std::vector<double> costs;
  const std::function<bool(const Progress&)> callback = [&](const Progress& progress) {
    costs.push_back(progress.cost);
    return true;
  };
  Monitor monitor(callback, 1000, 2, 2, std::stop_source());
  monitor.component_feasible();
  monitor.moved(-100, 0, "greedy");
  monitor.moved(-300, 0, "greedy");
  monitor.component_feasible();
  monitor.moved(-500, 0, "recovery");
  EXPECT_THAT(costs, ::testing::ElementsAre(kInfinity, kInfinity, 100));
}

TEST(Monitor, NeedsNoCallback) {
  std::stop_source stop;
  const std::function<bool(const Progress&)> none;
  Monitor monitor(none, 0, 1, 0, stop);
  monitor.add_component(-1);
  monitor.moved(-1, 0, "greedy");
  EXPECT_FALSE(stop.stop_requested());
}

// Ten rows without singletons, one column.
Problem ten_rows() {
  ProblemBuilder builder({10, 1});
  for (Index i = 1; i <= 10; ++i) {
    builder.add_arc({i, 0}, kInfinity);
    builder.add_arc({i, 1}, 1);
  }
  return std::move(builder).build();
}

TEST(InfeasibilityReason, NamesAnIndexWithoutArcsFirst) {
  const Problem problem = support::make_problem({2, 1}, {{{1, 1}, 1}}, kInfinity);
  EXPECT_EQ(infeasibility_reason(problem, {{0, 1}, {0, 2}}),
            "index 2 of dimension 1 has no arc and its singleton is forbidden");
}

TEST(InfeasibilityReason, NamesTheUncovered) {
  EXPECT_THAT(infeasibility_reason(ten_rows(), {{0, 3}}),
              HasSubstr("at least 1 stays uncovered, for instance index 3 of dimension 1"));
  EXPECT_THAT(infeasibility_reason(ten_rows(), {{0, 3}, {0, 7}}),
              HasSubstr("at least 2 stay uncovered, for instance index 3 of dimension 1, index 7"));
}

TEST(InfeasibilityReason, DoesNotListThemAll) {
  std::vector<RealIndex> uncovered;
  for (Index i = 1; i <= 9; ++i) uncovered.push_back({0, i});
  const std::string reason = infeasibility_reason(ten_rows(), uncovered);
  EXPECT_THAT(reason, HasSubstr("index 8 of dimension 1 and 1 more"));
  EXPECT_THAT(reason, Not(HasSubstr("index 9 of")));
}

TEST(IndicesWithoutArcs, AreThoseThatNothingCanCover) {
  const Problem problem = support::make_problem(
      {2, 2}, {{{1, 1}, 1}, {{2, 0}, kInfinity}, {{0, 1}, kInfinity}, {{0, 2}, 3}});
  const std::vector<RealIndex> lonely = indices_without_arcs(problem);
  ASSERT_EQ(lonely.size(), 1u);
  EXPECT_EQ(lonely[0].dimension, 0);
  EXPECT_EQ(lonely[0].index, 2u);
  EXPECT_THAT(indices_without_arcs(ten_rows()), IsEmpty());
}

TEST(PeakMemory, IsThatOfThisProcess) {
  EXPECT_GT(peak_memory_bytes(), std::size_t{1} << 20);
  EXPECT_LT(peak_memory_bytes(), std::size_t{1} << 40);
}

}  // namespace
}  // namespace nda::pipeline
