#include "cutting/cut_loop.hpp"

#include <gtest/gtest.h>

#include "cutting/cutting_support.hpp"

namespace nda::cutting {
namespace {

using core::Component;

// Without a cutoff nothing is proven before cuts find nothing any more, or the point is integral.
CutLoopEnd end_after(const Component& component, int rounds) {
  Master master(component, all_arcs(component), no_multipliers(component));
  CutLoopOptions options;
  options.max_rounds = rounds;
  return run_cut_loop(component, master, options, [](const Master&) { return 1e6; });
}

TEST(CutLoop, TellsCutsThatGainNothingFromRoundsThatRanOut) {
  int num_out = 0, num_stalled = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    SCOPED_TRACE(seed);
    const Component component = fractional_component(seed);
    const CutLoopEnd one = end_after(component, 1);
    const CutLoopEnd many = end_after(component, 200);
    ASSERT_TRUE(one == CutLoopEnd::kRounds || one == CutLoopEnd::kIntegral);
    ASSERT_TRUE(many == CutLoopEnd::kStalled || many == CutLoopEnd::kIntegral);
    num_out += one == CutLoopEnd::kRounds;
    num_stalled += many == CutLoopEnd::kStalled;
  }
  EXPECT_GT(num_out, 100);
  EXPECT_GT(num_stalled, 0);
}

}  // namespace
}  // namespace nda::cutting
