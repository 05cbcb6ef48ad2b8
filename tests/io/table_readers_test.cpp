#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/io_support.hpp"
#include "nda/io.hpp"

namespace nda::io {
namespace {

using ::testing::ElementsAre;

struct Malformed {
  const char* text;
  const char* message;
};

template <std::size_t n>
void expect_messages(const Malformed (&cases)[n], FileFormat format) {
  for (const Malformed& malformed : cases) {
    EXPECT_EQ(message_of([&] { parse_problem(malformed.text, {format}); }), malformed.message)
        << malformed.text;
  }
}

TEST(DenseReader, ReadsAllTuplesLastIndexFastestAndForbidsSingletons) {
  const Problem problem = parse_problem("3 2\n1 2 3 4\n5 6\n\n7 8", {FileFormat::kDense});
  EXPECT_THAT(problem.sizes(), ElementsAre(2, 2, 2));
  EXPECT_THAT(problem.costs(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_EQ(problem.find(std::vector<Index>{1, 2, 1}), 2u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_THAT(problem.singleton_costs(k), ElementsAre(0, kInfinity, kInfinity));
  }
}

TEST(DenseReader, TakesInfinityForAForbiddenTuple) {
  const Problem problem = parse_problem("2 2 1 inf inf 4", {FileFormat::kDense});
  EXPECT_THAT(problem.costs(), ElementsAre(1, 4));
  EXPECT_EQ(problem.num_forbidden(), 2u);
}

TEST(DenseReader, NamesLineAndValueOfEveryFault) {
  const Malformed kCases[] = {
      {"", "line 1: expected 'N s', found the end of the file"},
      {"x", "line 1: expected the number of dimensions, a whole number from 2 to 64, found 'x'"},
      {"1 5 1 2 3 4 5", "line 1: 1 dimensions given, 2 to 64 allowed"},
      {"3",
       "line 1: expected the size of the dimensions, a whole number up to 4294967295, found "
       "the end of the file"},
      {"3 -1",
       "line 1: expected the size of the dimensions, a whole number up to 4294967295, found "
       "'-1'"},
      {"2 4000000000", "line 1: 4000000000^2 costs announced, at most 4294967295 are supported"},
      {"64 3000000", "line 1: 3000000^64 costs announced, at most 4294967295 are supported"},
      {"64 1", "line 1: the file ends after 0 costs, 1 announced"},
      {"2 3000\n1 2\n", "line 1: 9000000 costs announced, too many for a file of at most 11 bytes"},
      {"2 2\n1 2\n3    \n\n", "line 5: the file ends after 3 costs, 4 announced"},
      {"2 2\n1 2\n3 4 5\n", "line 3: unexpected '5' after the last of 4 costs"},
      {"2 2\n1 2\n3 nan\n", "line 3: cost is NaN"},
      {"2 2\n1 2\n3 4,\n", "line 3: expected a cost within the range of double, found '4,'"},
      {"2 2\n\n1 1e999 3 4", "line 3: expected a cost within the range of double, found '1e999'"},
  };
  expect_messages(kCases, FileFormat::kDense);
}

TEST(DenseReader, RefusesAnOverlongWordAtABufferBoundary) {
  EXPECT_EQ(
      message_of([] { parse_problem("2 1\n" + std::string(1000000, '1'), {FileFormat::kDense}); }),
      "line 2: line is longer than 16384 characters");
}

TEST(CsvReader, TakesTheLargestIndicesForSizes) {
  const Problem problem =
      parse_problem("i1,i2,i3,cost\n2,1,0,3\r\n\n 0 , 4,0 , inf\n1,0,1,-2.5", {FileFormat::kCsv});
  EXPECT_THAT(problem.sizes(), ElementsAre(2, 4, 1));
  EXPECT_THAT(problem.costs(), ElementsAre(-2.5, 3));
  EXPECT_EQ(problem.singleton_costs(1)[4], kInfinity);
}

TEST(CsvReader, AcceptsAQuotedHeaderAndNoRows) {
  EXPECT_THAT(parse_problem("\"i1\",\"i2\",\"cost\"\n", {FileFormat::kCsv}).sizes(),
              ElementsAre(0, 0));
}

TEST(CsvReader, NamesLineAndValueOfEveryFault) {
  const Malformed kCases[] = {
      {"", "line 1: expected the header 'i1,...,iN,cost', found the end of the file"},
      {"1,2,3\n", "line 1: expected column 'i1' or 'cost' in the header, found '1'"},
      {"i1,i3,cost\n", "line 1: expected column 'i2' or 'cost' in the header, found 'i3'"},
      {"i1,i2\n", "line 1: expected a comma, found the end of the line"},
      {"i1,,cost\n", "line 1: expected column 'i2' or 'cost' in the header, found ''"},
      {"i1,cost\n", "line 1: 1 dimensions given, 2 to 64 allowed"},
      {"i1,i2,cost,label\n", "line 1: unexpected ','"},
      {"i1,i2,cost\n1,2\n", "line 2: expected a comma, found the end of the line"},
      {"i1,i2,cost\n1;2;3\n",
       "line 2: expected an index of dimension 1, a whole number up to "
       "4294967295, found '1;2;3'"},
      {"i1,i2,cost\n1,,3\n",
       "line 2: expected an index of dimension 2, a whole number up to 4294967295, found ','"},
      {"i1,i2,cost\n1,-2,3\n",
       "line 2: expected an index of dimension 2, a whole number up to 4294967295, found '-2'"},
      {"i1,i2,cost\n1,4294967296,3\n",
       "line 2: expected an index of dimension 2, a whole number up to 4294967295, found "
       "4294967296"},
      {"i1,i2,cost\n1,4000000000,3\n",
       "line 2: 4000000001 indices declared, at most 268435456 are supported"},
      {"i1,i2,cost\n1,2,\n",
       "line 2: expected a cost within the range of double, found the end of the line"},
      {"i1,i2,cost\n1,2,3,4\n", "line 2: unexpected ','"},
      {"i1,i2,cost\n1,2,nan\n", "line 2: cost is NaN"},
      {"i1,i2,cost\n1,2,3\n0,0,3\n", "line 3: all indices of the tuple are 0"},
  };
  expect_messages(kCases, FileFormat::kCsv);
}

TEST(ModelFormats, CannotBeRead) {
  EXPECT_EQ(message_of([] { parse_problem("", {FileFormat::kLp}); }),
            "format lp can only be written");
}

}  // namespace
}  // namespace nda::io
