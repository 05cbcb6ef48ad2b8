#include "io/scanner.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cstring>

#include "core/random.hpp"
#include "io/io_support.hpp"

namespace nda::io {
namespace {

// One number per line; false where one cannot be read.
bool read_number(const std::string& text, double& value) {
  const auto source = memory_source(text);
  Scanner scanner(*source);
  return scanner.next_line() && scanner.read_double(value) && scanner.at_line_end();
}

std::uint64_t bits(double value) {
  std::uint64_t result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

TEST(Scanner, ReadsNumbersAsTheStandardLibraryDoes) {
  const char* const kNumbers[] = {"0",
                                  "-0",
                                  "1",
                                  "-1",
                                  ".5",
                                  "5.",
                                  "0.1",
                                  "123456789012345",
                                  "1e22",
                                  "1e23",
                                  "1E-22",
                                  "1e-23",
                                  "3e+5",
                                  "0.3e-5",
                                  "1e308",
                                  "2.2250738585072011e-308",
                                  "5e-324",
                                  "inf",
                                  "INF",
                                  "-inf",
                                  "infinity",
                                  "9007199254740993",
                                  "9007199254740992",
                                  "18446744073709551615",
                                  "18446744073709551616",
                                  "0.000000000000000000000000000001",
                                  "100000000000000000000000000000",
                                  "1.7976931348623157e308",
                                  "123.4560000000000000000000000000000000"};
  for (const char* text : kNumbers) {
    double value = 0;
    ASSERT_TRUE(read_number(text, value)) << text;
    EXPECT_EQ(bits(value), bits(std::strtod(text, nullptr))) << text;
  }
}

TEST(Scanner, RefusesWhatIsNoNumber) {
  double value = 0;
  for (const char* text : {"",
                           ".",
                           "-",
                           "+",
                           "e5",
                           "1e",
                           "1e+",
                           "1.2.3",
                           "--1",
                           "+-1",
                           "-+1",
                           "0x1p3",
                           "1,5",
                           "1e400",
                           "1e99999999999",
                           "infin",
                           "x",
                           "1f"}) {
    EXPECT_FALSE(read_number(text, value)) << text;
  }
}

// All numbers, one per line, by one scanner, compared bit for bit with strtod.
void expect_correct_rounding(const std::vector<std::string>& numbers) {
  std::string text;
  for (const std::string& number : numbers) text.append(number).append("\n");
  const auto source = memory_source(text);
  Scanner scanner(*source);
  for (const std::string& number : numbers) {
    double value = 0;
    ASSERT_TRUE(scanner.next_line() && scanner.read_double(value)) << number;
    ASSERT_EQ(bits(value), bits(std::strtod(number.c_str(), nullptr))) << number;
    scanner.finish_line();
  }
}

// Random digits, point and exponent, where the fast path and the slow one meet.
TEST(Scanner, RoundsRandomDecimalsCorrectly) {
  core::Random random(1);
  std::vector<std::string> numbers;
  for (int trial = 0; trial < 200000; ++trial) {
    std::string number(random.below(2), '-');
    const std::uint64_t before = 1 + random.below(12);
    const std::uint64_t after = random.below(12);
    for (std::uint64_t i = 0; i < before; ++i) number += static_cast<char>('0' + random.below(10));
    if (after > 0) number += '.';
    for (std::uint64_t i = 0; i < after; ++i) number += static_cast<char>('0' + random.below(10));
    if (random.below(2) == 0) {
      number.append("e").append(std::to_string(static_cast<int>(random.below(60)) - 30));
    }
    numbers.push_back(std::move(number));
  }
  expect_correct_rounding(numbers);
}

TEST(Scanner, RestoresEveryDoubleFromItsShortestText) {
  core::Random random(2);
  std::vector<std::string> numbers;
  for (int trial = 0; trial < 200000; ++trial) {
    const std::uint64_t pattern = random();
    double number = 0;
    std::memcpy(&number, &pattern, sizeof number);
    if (!std::isfinite(number)) continue;
    char text[32];
    numbers.emplace_back(text, std::to_chars(text, text + sizeof text, number).ptr);
    ASSERT_EQ(bits(std::strtod(numbers.back().c_str(), nullptr)), pattern);
  }
  expect_correct_rounding(numbers);
}

TEST(Scanner, ReadsWholeNumbersOfAtMost64Bits) {
  const std::string text = "0 007 4294967296 9999999999999999999 99999999999999999999";
  const auto source = memory_source(text);
  Scanner scanner(*source);
  ASSERT_TRUE(scanner.next_line());
  std::uint64_t value = 0;
  for (const std::uint64_t expected : {std::uint64_t{0},
                                       std::uint64_t{7},
                                       std::uint64_t{4294967296},
                                       std::uint64_t{9999999999999999999u}}) {
    ASSERT_TRUE(scanner.read_unsigned(value));
    EXPECT_EQ(value, expected);
  }
  EXPECT_FALSE(scanner.read_unsigned(value));
  EXPECT_EQ(scanner.found(), "'99999999999999999999'");
}

TEST(Scanner, FindsWordsAcrossLinesAndBuffers) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += (i % 7 == 0 ? "\n\n " : "     ") + std::to_string(i);
  const auto source = memory_source(text);
  Scanner scanner(*source);
  for (int i = 0; i < 100000; ++i) {
    ASSERT_TRUE(scanner.next_word());
    double value = 0;
    ASSERT_TRUE(scanner.read_double(value));
    ASSERT_EQ(value, i);
  }
  EXPECT_FALSE(scanner.next_word());
  EXPECT_EQ(scanner.line(), 1u + 2 * (100000 / 7 + 1));
}

TEST(Scanner, KnowsTheSizeOfWhatItReadToTheEnd) {
  const auto source = memory_source("1 2 3\n");
  Scanner scanner(*source);
  EXPECT_EQ(scanner.max_bytes(), 6u);
  EXPECT_EQ(scanner.bytes_read(), 6u);
}

}  // namespace
}  // namespace nda::io
