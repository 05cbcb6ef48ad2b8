#include "solve/monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "solve/process.hpp"

namespace nda::pipeline {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Monitor, AddsUpWhatTheComponentsReport) {
  std::vector<Progress> seen;
  const std::function<bool(const Progress&)> callback = [&](const Progress& progress) {
    seen.push_back(progress);
    return true;
  };
  Monitor monitor(callback, std::stop_source());
  monitor.begin(100, 2, 0);
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
  Monitor monitor(callback, stop);
  monitor.begin(0, 1, 0);
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
  Monitor monitor(callback, std::stop_source());
  monitor.begin(1000, 2, 2);
  monitor.component_feasible();
  monitor.moved(-100, 0, "greedy");
  monitor.moved(-300, 0, "greedy");
  monitor.component_feasible();
  monitor.moved(-500, 0, "recovery");
  EXPECT_THAT(costs, ElementsAre(kInfinity, kInfinity, 100));
}

TEST(Monitor, NeedsNoCallback) {
  std::stop_source stop;
  const std::function<bool(const Progress&)> none;
  Monitor monitor(none, stop);
  monitor.begin(0, 1, 0);
  monitor.add_component(-1);
  monitor.moved(-1, 0, "greedy");
  EXPECT_FALSE(stop.stop_requested());
}

TEST(Monitor, BeatsOnlyWhereNothingWasToldForLong) {
  std::vector<Progress> seen;
  const std::function<bool(const Progress&)> callback = [&](const Progress& progress) {
    seen.push_back(progress);
    return true;
  };
  Monitor monitor(callback, std::stop_source());
  monitor.heartbeat();
  EXPECT_THAT(seen, IsEmpty());
  std::this_thread::sleep_for(std::chrono::duration<double>(Monitor::kHeartbeatSeconds));
  for (unsigned call = 0; call < 3 * Monitor::kCallsPerLook; ++call) monitor.heartbeat();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_STREQ(seen[0].event, "working");
  EXPECT_EQ(seen[0].cost, kInfinity) << "nothing is known yet";
}

TEST(PeakMemory, IsThatOfThisProcess) {
  EXPECT_GT(peak_memory_bytes(), std::size_t{1} << 20);
  EXPECT_LT(peak_memory_bytes(), std::size_t{1} << 40);
}

}  // namespace
}  // namespace nda::pipeline
