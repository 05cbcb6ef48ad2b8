#include "core/clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace nda::core {
namespace {

using namespace std::chrono_literals;

TEST(Stopwatch, MeasuresAtLeastTheTimeSlept) {
  const Stopwatch watch;
  std::this_thread::sleep_for(5ms);
  const double first = watch.seconds();
  EXPECT_GE(first, 0.005);
  EXPECT_GE(watch.seconds(), first);
}

TEST(Deadline, IsNeverReachedByDefault) {
  const Deadline deadline;
  EXPECT_FALSE(deadline.reached());
  EXPECT_FALSE(deadline.expired());
  EXPECT_FALSE(deadline.interrupted());
  EXPECT_EQ(deadline.remaining_s(), std::numeric_limits<double>::infinity());
}

TEST(Deadline, ExpiresAfterItsLimit) {
  const Deadline deadline(0.02);
  EXPECT_LE(deadline.remaining_s(), 0.02);
  std::this_thread::sleep_for(21ms);
  EXPECT_TRUE(deadline.expired());
  EXPECT_TRUE(deadline.reached());
  EXPECT_FALSE(deadline.interrupted());
  EXPECT_LE(deadline.remaining_s(), 0);
  EXPECT_GE(deadline.seconds(), 0.02);
}

TEST(Deadline, OfAnHourHasNotExpired) {
  const Deadline deadline(3600);
  EXPECT_FALSE(deadline.reached());
  EXPECT_GT(deadline.remaining_s(), 3000);
}

TEST(Deadline, OfNoTimeIsReachedAtOnce) {
  EXPECT_TRUE(Deadline(0).reached());
  EXPECT_TRUE(Deadline(-1).reached());
}

TEST(Deadline, IsReachedWhenAskedToStop) {
  std::stop_source source;
  const Deadline deadline(3600, source.get_token());
  const Deadline copy = deadline;
  EXPECT_FALSE(deadline.reached());
  source.request_stop();
  for (const Deadline& asked : {deadline, copy}) {
    EXPECT_TRUE(asked.reached());
    EXPECT_TRUE(asked.interrupted());
    EXPECT_FALSE(asked.expired());
    EXPECT_TRUE(asked.stop().stop_requested());
  }
}

}  // namespace
}  // namespace nda::core
