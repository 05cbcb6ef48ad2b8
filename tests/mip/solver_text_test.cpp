#include "mip/solver_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mip_support.hpp"

namespace nda::mip {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Optional;

TEST(SolverText, ReadsNumbersAndNothingElse) {
  EXPECT_THAT(number_in("-2.5e3"), Optional(-2500));
  for (const char* word : {"", "x", "1x", "inf", "-inf", "nan", "1e999"}) {
    EXPECT_FALSE(number_in(word)) << word;
  }
}

TEST(SolverText, ReadsCountsAndNothingElse) {
  EXPECT_THAT(count_in("12"), Optional(12));
  for (const char* word : {"-1", "1.5", "1e30", "a"}) EXPECT_FALSE(count_in(word)) << word;
}

TEST(SolverText, LowersANumberByAUnitOfItsLastDigit) {
  EXPECT_THAT(lowered_number_in("-208.534"), Optional(DoubleNear(-208.535, 1e-9)));
  EXPECT_THAT(lowered_number_in("5"), Optional(DoubleNear(4, 1e-9)));
  EXPECT_THAT(lowered_number_in("-2.05e+02"), Optional(DoubleNear(-206, 1e-9)));
  EXPECT_THAT(lowered_number_in("2.50E-03"), Optional(DoubleNear(0.00249, 1e-9)));
  EXPECT_FALSE(lowered_number_in("-inf"));
}

TEST(SolverText, TakesTheWordsBehindTheLastKey) {
  const std::vector<std::string> lines = {"a bound: 1 x", "  bound: 2  y z", "end"};
  EXPECT_THAT(words_after_last(lines, "bound:"), ElementsAre("2", "y", "z"));
  EXPECT_THAT(words_after_last(lines, "gap"), IsEmpty());
}

TEST(SolverText, FindsNoLinesInAMissingFile) {
  EXPECT_THAT(read_lines("/no/such/file"), IsEmpty());
}

}  // namespace
}  // namespace nda::mip
