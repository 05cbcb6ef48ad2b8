#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "io/io_support.hpp"
#include "nda/io.hpp"

namespace nda {
namespace {

using ::testing::HasSubstr;

WarmStart example() {
  return {{{-1.5, 0.1}, {}, {1e-300, -1e300}}, {{1, 0, 2}, {2, 4000000000, 1}}};
}

std::string fault_of(const std::string& text) {
  try {
    warm_start_from_json(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string with(const std::string& multipliers, const std::string& arcs) {
  return R"({"format": "nda-warm-start", "version": 1, "multipliers": )" + multipliers +
         ", \"arcs\": " + arcs + "}";
}

TEST(WarmStartFile, RestoresEveryBit) {
  const WarmStart read = warm_start_from_json(warm_start_to_json(example()));
  EXPECT_EQ(read.multipliers, example().multipliers);
  EXPECT_EQ(read.arcs, example().arcs);
  EXPECT_TRUE(warm_start_from_json(warm_start_to_json({})).empty());
}

TEST(WarmStartFile, IsReadFromAFileCompressedOrNot) {
  const io::TemporaryFolder folder;
  for (const char* name : {"a.warm", "a.warm.gz"}) {
    write_warm_start(example(), folder / name);
    EXPECT_EQ(read_warm_start(folder / name).multipliers, example().multipliers);
  }
}

TEST(WarmStartFile, NamesThePlaceOfAFault) {
  EXPECT_THAT(fault_of("{"), HasSubstr("invalid JSON"));
  EXPECT_THAT(fault_of("[]"), HasSubstr("expected an object"));
  EXPECT_THAT(fault_of("{}"), HasSubstr("field 'format' is missing"));
  EXPECT_THAT(fault_of(R"({"format": "nda-solution"})"),
              HasSubstr("format: expected \"nda-warm-start\""));
  EXPECT_THAT(fault_of(R"({"format": "nda-warm-start", "version": 0})"), HasSubstr("version"));
  EXPECT_THAT(fault_of(with(R"([[1], [2, "x"]])", "[]")), HasSubstr("multipliers[1][1]: expected"));
  EXPECT_THAT(fault_of(with(R"([["inf"]])", "[]")),
              HasSubstr("multipliers[0][0]: expected a finite"));
  EXPECT_THAT(fault_of(with("[1]", "[]")), HasSubstr("multipliers[0]: expected an array"));
  EXPECT_THAT(fault_of(with("[]", "[[1, -1]]")), HasSubstr("arcs[0][1]: expected a whole number"));
  EXPECT_THAT(fault_of(with("[]", "[[4294967296]]")), HasSubstr("arcs[0][0]"));
}

TEST(WarmStartFile, HoldsFiniteMultipliersOnly) {
  WarmStart warm = example();
  warm.multipliers[2][0] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(warm_start_to_json(warm), InputError);
}

}  // namespace
}  // namespace nda
