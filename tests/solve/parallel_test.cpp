#include "solve/parallel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/clock.hpp"

namespace nda::pipeline {
namespace {

TEST(ForAll, CallsEveryNumberOnce) {
  for (const int threads : {0, 1, 2, 5}) {
    for (const std::size_t count : {0, 1, 2, 1000}) {
      std::vector<std::atomic<int>> calls(count);
      std::atomic<bool> known = true;
      for_all(count, threads, [&](std::size_t i, std::size_t worker) {
        ++calls[i];
        if (worker >= static_cast<std::size_t>(num_workers(threads))) known = false;
      });
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(calls[i], 1) << i << " of " << count;
      EXPECT_TRUE(known);
    }
  }
}

// Two calls that wait for each other end only where both are at work.
TEST(ForAll, HasSeveralCallsAtWork) {
  if (num_workers(2) < 2) GTEST_SKIP() << "one core: no test of threads has more than one thread";
  const core::Deadline deadline(10);
  std::atomic<int> begun = 0;
  for_all(2, 2, [&](std::size_t, std::size_t) {
    ++begun;
    while (begun < 2 && !deadline.reached()) std::this_thread::yield();
    EXPECT_EQ(begun, 2);
  });
}

// Each thread gets ascending numbers.
TEST(ForAll, HandsNumbersOutInAscendingOrder) {
  constexpr int kThreads = 2;
  std::vector<std::vector<std::size_t>> numbers(static_cast<std::size_t>(num_workers(kThreads)));
  for_all(1000, kThreads, [&](std::size_t i, std::size_t worker) { numbers[worker].push_back(i); });
  for (const auto& of_worker : numbers) {
    EXPECT_TRUE(std::is_sorted(of_worker.begin(), of_worker.end()));
  }
}

// A thread that waits for the calls within a call takes up no other call meanwhile.
TEST(ForAll, ServesCallsWithinCalls) {
  static thread_local bool is_within = false;
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> calls(20 * 50);
    std::atomic<int> mixed = 0;
    for_all(20, threads, [&](std::size_t i, std::size_t) {
      if (is_within) ++mixed;
      is_within = true;
      for_all(50, threads, [&](std::size_t j, std::size_t) { ++calls[50 * i + j]; });
      is_within = false;
    });
    for (const std::atomic<int>& number : calls) ASSERT_EQ(number, 1);
    EXPECT_EQ(mixed, 0);
  }
}

TEST(ForAll, ThrowsOnWhatACallThrowsAndLeavesOutTheRest) {
  for (const int threads : {1, 2}) {
    std::atomic<int> calls = 0;
    const auto work = [&](std::size_t, std::size_t) {
      ++calls;
      throw std::runtime_error("thrown by a call");
    };
    EXPECT_THROW(for_all(100000, threads, work), std::runtime_error);
    EXPECT_LE(calls, num_workers(threads));
  }
}

}  // namespace
}  // namespace nda::pipeline
