#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "io/io_support.hpp"
#include "nda/io.hpp"

namespace nda::io {
namespace {

using ::testing::ElementsAre;

Problem parse(const std::string& text) {
  return parse_problem(text);
}
std::string error(const std::string& text) {
  return message_of([&] { parse(text); });
}

TEST(NdaReader, ReadsArcsSingletonsCommentsAndBlankLines) {
  const Problem problem = parse(
      "c a comment\n"
      "\n"
      "p nda 3 2 2 1 5\n"
      "a 2 1 0 3\n"
      "cost lines begin with a\n"
      "a 1 2 1 -1.5e1\n"
      "   \t \n"
      "a 0 2 0 inf\n"
      "b 2 1 1 1\n"
      "a 1 0 1 .5\n"
      "a 1 0 0 +7.");
  EXPECT_THAT(problem.sizes(), ElementsAre(2, 2, 1));
  EXPECT_THAT(problem.indices(0), ElementsAre(1, 1, 2));
  EXPECT_THAT(problem.indices(1), ElementsAre(0, 2, 1));
  EXPECT_THAT(problem.indices(2), ElementsAre(1, 1, 0));
  EXPECT_THAT(problem.costs(), ElementsAre(0.5, -15, 3));
  EXPECT_THAT(problem.singleton_costs(0), ElementsAre(0, 7, 0));
  EXPECT_THAT(problem.singleton_costs(1), ElementsAre(0, 0, kInfinity));
}

TEST(NdaReader, AcceptsCarriageReturnsTabsAndAByteOrderMark) {
  EXPECT_TRUE(same_problem(parse("\xef\xbb\xbfp nda\t2 1 1 1\r\n\r\n  a\t1  1 4 \r\n"),
                           parse("p nda 2 1 1 1\na 1 1 4\n")));
}

TEST(NdaReader, KeepsTheCheapestDuplicateAndDropsForbiddenArcs) {
  const Problem problem = parse("p nda 2 1 2 4\na 1 1 4\na 1 1 3\na 1 1 5\na 1 2 Inf\n");
  EXPECT_THAT(problem.costs(), ElementsAre(3));
  EXPECT_EQ(problem.num_duplicates(), 2u);
  EXPECT_EQ(problem.num_forbidden(), 1u);
}

TEST(NdaReader, AcceptsEmptyProblems) {
  EXPECT_EQ(parse("p nda 2 0 0 0").num_indices(), 0u);
  EXPECT_EQ(parse("p nda 2 3 4 0\n").num_indices(), 7u);
}

struct Malformed {
  const char* text;
  const char* message;
};

template <std::size_t n>
void expect_messages(const Malformed (&cases)[n]) {
  for (const Malformed& malformed : cases) {
    EXPECT_EQ(error(malformed.text), malformed.message) << malformed.text;
  }
}

TEST(NdaReader, NamesLineAndValueOfEveryFaultInTheHeader) {
  const Malformed kCases[] = {
      {"", "line 1: expected a line 'p nda ...', found the end of the file"},
      {"c only\n\n", "line 3: expected a line 'p nda ...', found the end of the file"},
      {"a 1 1 1\np nda 2 1 1 1\n", "line 1: 'a' line before the 'p' line"},
      {"b 1 1 1 1\np nda 2 1 1 0\n", "line 1: 'b' line before the 'p' line"},
      {"p nda 2 1 1 0\nc\np nda 2 1 1 0\n", "line 3: second 'p' line"},
      {"p min 3 4\n", "line 1: expected 'p nda', found 'min'"},
      {"p\n", "line 1: expected 'p nda', found the end of the line"},
      {"p", "line 1: expected 'p nda', found the end of the file"},
      {"\np nda\n",
       "line 2: expected the number of dimensions, a whole number from 2 to 64, found the end of "
       "the line"},
      {"p nda 1 5 0\n", "line 1: 1 dimensions given, 2 to 64 allowed"},
      {"p nda 65 5 0\n", "line 1: 65 dimensions given, 2 to 64 allowed"},
      {"p nda 1000000000 5 0\n", "line 1: 1000000000 dimensions given, 2 to 64 allowed"},
      {"p nda -2 5 0\n",
       "line 1: expected the number of dimensions, a whole number from 2 to 64, found '-2'"},
      {"p nda 99999999999999999999 5 0\n",
       "line 1: expected the number of dimensions, a whole number from 2 to 64, found "
       "'99999999999999999999'"},
      {"p nda 2 3 -4 0\n",
       "line 1: expected the size of dimension 2, a whole number up to 4294967295, found '-4'"},
      {"p nda 2 3 4294967296 0\n",
       "line 1: the size of dimension 2 is 4294967296, at most 4294967295 allowed"},
      {"p nda 2 3 4\n",
       "line 1: expected the number of arcs, a whole number up to 4294967295, found the end of the "
       "line"},
      {"p nda 2 3 4 x\n",
       "line 1: expected the number of arcs, a whole number up to 4294967295, found 'x'"},
      {"p nda 2 3 4 1.5\n",
       "line 1: expected the number of arcs, a whole number up to 4294967295, found '1.5'"},
      {"p nda 2 3 4 -1\n",
       "line 1: expected the number of arcs, a whole number up to 4294967295, found '-1'"},
      {"p nda 2 3 4 0 7\n", "line 1: unexpected '7'"},
      {"p nda 2 3 4 4000000000\n",
       "line 1: 4000000000 arcs announced, too many for a file of at most 23 bytes"},
      {"p nda 2 4000000000 4000000000 0\n",
       "line 1: 8000000000 indices declared, at most 268435456 are supported"},
      {"p nda 2 200000000 1 0\n",
       "line 1: 200000001 indices declared, too many for a file of at most 22 bytes (at most one "
       "per byte and 16777216 more)"},
  };
  expect_messages(kCases);
}

TEST(NdaReader, NamesLineAndValueOfEveryFaultInAnArc) {
  const Malformed kCases[] = {
      {"p nda 2 3 7 1\na 1 9 4\n", "line 2: index 9 of dimension 2 exceeds 7"},
      {"p nda 2 3 7 1\na 9999999999 1 4\n", "line 2: index 9999999999 of dimension 1 exceeds 3"},
      {"p nda 2 3 7 1\na -1 1 4\n", "line 2: expected an index of dimension 1, found '-1'"},
      {"p nda 2 3 7 1\na 1 2.5 4\n", "line 2: expected an index of dimension 2, found '2.5'"},
      {"p nda 2 3 7 1\na 1\n",
       "line 2: expected an index of dimension 2, found the end of the line"},
      {"p nda 2 3 7 1\na 1 99999999999999999999 4\n",
       "line 2: expected an index of dimension 2, found '99999999999999999999'"},
      {"p nda 2 3 7 1\na 1 2\n",
       "line 2: expected a cost within the range of double, found the end of the line"},
      {"p nda 2 3 7 1\na 1 2",
       "line 2: expected a cost within the range of double, found the end of "
       "the file"},
      {"p nda 2 3 7 1\na 1 2 4x\n",
       "line 2: expected a cost within the range of double, found '4x'"},
      {"p nda 2 3 7 1\na 1 2 1e999\n",
       "line 2: expected a cost within the range of double, found '1e999'"},
      {"p nda 2 3 7 1\na 1 2 +-4\n",
       "line 2: expected a cost within the range of double, found '+-4'"},
      {"p nda 2 3 7 1\na 1 2 0x10\n",
       "line 2: expected a cost within the range of double, found '0x10'"},
      {"p nda 2 3 7 1\na 1 2 nan\n", "line 2: cost is NaN"},
      {"p nda 2 3 7 1\na 1 2 -inf\n", "line 2: cost is -inf"},
      {"p nda 2 3 7 1\na 1 2 3 4\n", "line 2: unexpected '4'"},
      {"p nda 2 3 7 1\na 0 0 3\n", "line 2: all indices of the tuple are 0"},
      {"p nda 2 3 7 1\na1 2 3\n",
       "line 2: expected a line that begins with a, b, c or p, found 'a1'"},
      {"p nda 2 3 7 1\nx 1 2 3\n",
       "line 2: expected a line that begins with a, b, c or p, found 'x'"},
      {"p nda 2 3 7 1\n1 2 3\n",
       "line 2: expected a line that begins with a, b, c or p, found '1'"},
      {"p nda 2 3 7 2\na 1 2 3\n\n", "line 4: the file ends after 1 arc lines, 2 announced"},
      {"p nda 2 3 7 1\na 1 2 3\na 1 3 3\n", "line 3: more than the 1 arc lines announced"},
      {"\x7f\x45LF\x01\x02\xff\n",
       "line 1: expected a line that begins with a, b, c or p, found '\\x7fELF\\x01\\x02\\xff'"},
      {"an uncommonly long word: abcdefghijklmnopqrstuvwxyz\n",
       "line 1: expected a line that begins with a, b, c or p, found 'an'"},
      {"abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz\n",
       "line 1: expected a line that begins with a, b, c or p, found "
       "'abcdefghijklmnopqrstuvwxyzabcdef...'"},
  };
  expect_messages(kCases);
}

TEST(NdaReader, NamesLineAndValueOfEveryFaultInBounds) {
  const Malformed kCases[] = {
      {"p nda 2 3 7 0\nb 2 5 3 2\n", "line 2: lower bound 3 exceeds upper bound 2"},
      {"p nda 2 3 7 0\nb 3 1 1 1\n", "line 2: a dimension is 3, at most 2 allowed"},
      {"p nda 2 3 7 0\nb 0 1 1 1\n", "line 2: dimension 0 does not exist, the first is 1"},
      {"p nda 2 3 7 0\nb 1 0 1 1\n", "line 2: index 0 of dimension 1 has no bounds"},
      {"p nda 2 3 7 0\nb 1 4 1 1\n", "line 2: index 4 of dimension 1 exceeds 3"},
      {"p nda 2 3 7 0\nb 1 1 x 1\n",
       "line 2: expected a lower bound, a whole number up to 4294967294, found 'x'"},
      {"p nda 2 3 7 0\nb 1 1 1\n",
       "line 2: expected an upper bound, a whole number up to 4294967294, found the end of the "
       "line"},
      {"p nda 2 3 7 0\nb 1 1 1 1 1\n", "line 2: unexpected '1'"},
      {"p nda 2 3 7 0\nb 1 1 inf inf\n",
       "line 2: expected a lower bound, a whole number up to 4294967294, found 'inf'"},
      {"p nda 2 3 7 0\nb 1 1 0 -inf\n",
       "line 2: expected an upper bound, a whole number up to 4294967294, found '-inf'"},
      {"p nda 2 3 7 0\nb 1 1 0 4294967295\n",
       "line 2: an upper bound is 4294967295, at most 4294967294 allowed"},
      {"p nda 2 3 7 1\nb 2 4 0 inf\na 0 4 -3\n",
       "index 4 of dimension 2 may be used without limit and alone costs -3: there is no least "
       "cost"},
  };
  expect_messages(kCases);
}

TEST(NdaReader, ReadsBoundsOnUses) {
  const Problem problem =
      parse("p nda 2 3 2 1\nb 1 2 0 inf\nb 2 1 1 2\na 1 1 4\nb 1 3 7 7\nb 2 1 0 4294967294\n");
  EXPECT_EQ(problem.use_bounds(0, 1), UseBounds{});
  EXPECT_EQ(problem.use_bounds(0, 2), (UseBounds{0, UseBounds::kUnlimited}));
  EXPECT_EQ(problem.use_bounds(0, 3), (UseBounds{7, 7}));
  EXPECT_EQ(problem.use_bounds(1, 1), (UseBounds{0, 4294967294})) << "the last line counts";
  EXPECT_FALSE(parse("p nda 2 3 2 0\nb 1 2 1 1\n").is_many_to_one());
}

TEST(NdaReader, RefusesAZeroByte) {
  EXPECT_EQ(error(std::string("p nda 2 1 1 1\na 1 1 4\0\n", 23)),
            "line 2: expected a cost within the range of double, found '4\\x00'");
}

TEST(NdaReader, SkipsCommentsOfAnyLengthButRefusesOverlongLines) {
  const std::string header = "p nda 2 1 1 1\n";
  EXPECT_EQ(parse(header + "c " + std::string(1000000, 'x') + "\na 1 1 4\n").num_arcs(), 1u);
  const std::string kTooLong = "line 2: line is longer than 16384 characters";
  EXPECT_EQ(error(header + "a 1 1 " + std::string(1000000, '1')), kTooLong);
  EXPECT_EQ(error(header + "a " + std::string(1000000, '0') + "1 1 4"), kTooLong);
  EXPECT_EQ(error(header + "a 1 1 4" + std::string(1000000, ' ')), kTooLong);
  EXPECT_EQ(error(header + std::string(1000000, ' ')), kTooLong);
  EXPECT_EQ(error(header + std::string(1000000, 'y')), kTooLong);
}

TEST(NdaReader, CountsLinesAcrossBufferBoundaries) {
  std::string text = "p nda 2 1 1 200001\n";
  for (int line = 0; line < 200000; ++line) text += "a 1 1 4\n";
  EXPECT_EQ(error(text + "a 1 2 4\n"), "line 200002: index 2 of dimension 2 exceeds 1");
  EXPECT_EQ(parse(text + "a 1 1 3").costs()[0], 3);
}

TEST(NdaReader, ReadsTheSameFromAStream) {
  const std::string text = "p nda 2 1 1 1\na 1 1 4\n";
  std::istringstream stream(text);
  EXPECT_TRUE(same_problem(read_problem(stream), parse(text)));
}

TEST(NdaReader, AllowsManyUnusedIndicesOnlyWithinTheGivenLimit) {
  const std::string text = "p nda 2 1000 1000 0\n";
  EXPECT_EQ(parse_problem(text, {FileFormat::kNda, 1980}).num_indices(), 2000u);
  EXPECT_EQ(message_of([&] {
              parse_problem(text, {FileFormat::kNda, 1979});
            }),
            "line 1: 2000 indices declared, too many for a file of at most 20 bytes (at most one "
            "per byte and 1979 more)");
}

}  // namespace
}  // namespace nda::io
