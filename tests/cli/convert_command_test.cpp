#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "support/build_kind.hpp"

namespace nda::cli {
namespace {

using io::contents;
using io::TemporaryFolder;
using io::write_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kText = "p nda 2 2 2 3\na 0 1 7\na 1 1 4\na 2 2 -3.5\n";

TEST(ConvertCommand, DoesNotReplaceItsInput) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "c kept\np nda 2 1 1 1\na 1 1 -1\n");
  const Outcome outcome = run(folder, "nda convert a.nda ./a.nda");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.log, HasSubstr("./a.nda: cannot write: it is the problem itself"));
  EXPECT_THAT(contents(folder / "a.nda"), HasSubstr("c kept"));
}

TEST(ConvertCommand, GoesThroughEveryFormatAndBack) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kText);
  const Outcome outcome = run(folder,
                              "nda convert a.nda b.csv.gz && nda convert b.csv.gz c.nda.gz && "
                              "nda convert - - < c.nda.gz");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_EQ(outcome.output, kText);
  EXPECT_EQ(outcome.log, "");
}

TEST(ConvertCommand, ReadsTheSameFromFileCompressedFileAndPipe) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kText);
  for (const char* command : {"nda convert a.nda -",
                              "gzip a.nda; nda convert a.nda.gz -",
                              "cat a.nda.gz | nda convert - -",
                              "gunzip -c a.nda.gz | nda convert - -",
                              "nda convert - - < a.nda.gz"}) {
    const Outcome outcome = run(folder, command);
    EXPECT_EQ(outcome.code, 0) << command << outcome.log;
    EXPECT_EQ(outcome.output, kText) << command;
  }
}

TEST(ConvertCommand, TakesFormatsWhereNamesDoNotTell) {
  const TemporaryFolder folder;
  write_file(folder / "matrix", "2 2 1 2 3 4");
  const Outcome outcome = run(folder, "nda convert --from dense --to csv matrix -");
  EXPECT_EQ(outcome.code, 0) << outcome.log;
  EXPECT_THAT(outcome.output, HasSubstr("i1,i2,cost\n1,0,inf\n"));
  EXPECT_THAT(outcome.output, HasSubstr("\n2,2,4\n"));
}

TEST(ConvertCommand, NamesWhatIsWrongInOneLine) {
  const TemporaryFolder folder;
  write_file(folder / "bad.nda", "p nda 2 3 7 1\na 1 9 4\n");
  write_file(folder / "good.nda", kText);
  const struct {
    const char* arguments;
    const char* message;
  } kCases[] = {
      {"bad.nda out.nda", "nda: bad.nda: line 2: index 9 of dimension 2 exceeds 7\n"},
      {"none.nda out.nda", "nda: none.nda: cannot open: No such file or directory\n"},
      {"- out.nda < bad.nda", "nda: standard input: line 2: index 9 of dimension 2 exceeds 7\n"},
      {"good.nda none/out.nda", "nda: none/out.nda: cannot write: No such file or directory\n"},
      {"good.nda out",
       "nda: cannot tell the format of 'out' by its name, known are .nda, .csv, .dense, .txt, .lp "
       "and .mps\n"},
      {"good.nda out.nda --to dense", "nda: out.nda: format dense can only be read\n"},
      {"good.nda out.nda --from lp", "nda: good.nda: format lp can only be written\n"},
      {"good.nda out.nda --to xls",
       "nda: unknown format 'xls', expected auto, nda, dense, csv, lp or mps\n"},
      {"good.nda - > /dev/full", "nda: standard output: cannot write: No space left on device\n"},
  };
  for (const auto& wrong : kCases) {
    const Outcome outcome = run(folder, std::string("nda convert ") + wrong.arguments);
    EXPECT_EQ(outcome.code, 2) << wrong.arguments;
    EXPECT_EQ(outcome.output, "");
    EXPECT_EQ(outcome.log, wrong.message);
  }
  EXPECT_THAT(folder.files(), ::testing::UnorderedElementsAre("bad.nda", "good.nda"));
}

// A claim the file can back only with more memory than there is must end in a sentence.
TEST(ConvertCommand, SurvivesALackOfMemory) {
  if (support::kIsSanitized) GTEST_SKIP() << "sanitizers need all addresses";
  const TemporaryFolder folder;
  write_file(folder / "a.nda", "p nda 2 16000000 0 0\n");
  const Outcome outcome = run(folder, "ulimit -v 80000; nda convert a.nda b.nda");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.log, "nda: out of memory\n");
  EXPECT_THAT(folder.files(), ElementsAre("a.nda"));
}

// Whatever a small file claims, it gets a sentence within 100 MB of address space, not "out of
// memory".
TEST(ConvertCommand, RefusesLargeClaimsWithoutAllocatingForThem) {
  if (support::kIsSanitized) GTEST_SKIP() << "sanitizers need all addresses";
  const TemporaryFolder folder;
  write_file(folder / "arcs.nda", "p nda 2 1 1 4000000000\na 1 1 1\n");
  write_file(folder / "sizes.nda", "p nda 3 4000000000 4000000000 4000000000 1\na 1 1 1 1\n");
  write_file(folder / "size.nda", "p nda 2 250000000 1 1\na 1 1 1\n");
  write_file(folder / "cube.dense", "3 1600\n1 2 3\n");
  write_file(folder / "square.dense", "2 65535\n1 2 3\n");
  write_file(folder / "row.csv", "i1,i2,cost\n250000000,1,4\n");
  for (const std::string& name : folder.files()) {
    for (const std::string& command : {"nda convert " + name + " out.nda",
                                       "gzip -c " + name + " | nda convert --from " +
                                           name.substr(name.rfind('.') + 1) + " - out.nda"}) {
      const Outcome outcome = run(folder, "ulimit -v 100000; " + command);
      EXPECT_EQ(outcome.code, 2) << command;
      EXPECT_THAT(
          outcome.log,
          ::testing::AnyOf(HasSubstr("too many for a file of at most"), HasSubstr("are supported")))
          << command;
    }
  }
}

TEST(ConvertCommand, LeavesNoPartWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write_file(folder / "a.nda", kText);
  ProblemBuilder builder({200, 200});
  for (Index i = 1; i <= 200; ++i) {
    for (Index j = 1; j <= 200; ++j) builder.add_arc({i, j}, i + j);
  }
  write_problem(std::move(builder).build(), folder / "b.nda");
  const Outcome outcome = run(folder, "trap '' XFSZ; ulimit -f 100; nda convert b.nda a.nda");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.log, "nda: a.nda: cannot write: File too large\n");
  EXPECT_EQ(contents(folder / "a.nda"), kText);
  EXPECT_THAT(folder.files(), ::testing::UnorderedElementsAre("a.nda", "b.nda"));
}

}  // namespace
}  // namespace nda::cli
