#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>

#include "io/io_support.hpp"
#include "nda/io.hpp"

namespace nda::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const std::string kText = "p nda 2 2 2 2\na 1 1 4\na 2 2 -3.5\n";

TEST(Files, KeepRandomProblemsBitForBitInEveryFormat) {
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_problem(seed, 8);
    for (const char* name : {"a.nda", "a.nda.gz", "a.csv", "a.csv.gz"}) {
      write_problem(problem, folder / name);
      ASSERT_TRUE(same_problem(read_problem(folder / name), problem)) << name;
    }
  }
}

TEST(Files, KeepProblemsOf64Dimensions) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = random_problem(seed, 64);
    for (const FileFormat format : {FileFormat::kNda, FileFormat::kCsv}) {
      ASSERT_TRUE(same_problem(parse_problem(text_of(problem, format), {format}), problem));
    }
  }
}

TEST(Files, KeepADenseProblemThroughTheOtherFormats) {
  const Problem problem = parse_problem("3 2 1 2 3 4 5 6 inf 8", {FileFormat::kDense});
  for (const FileFormat format : {FileFormat::kNda, FileFormat::kCsv}) {
    EXPECT_TRUE(same_problem(parse_problem(text_of(problem, format), {format}), problem));
  }
}

TEST(Files, KnowTheFormatByTheName) {
  EXPECT_EQ(format_of("a.nda"), FileFormat::kNda);
  EXPECT_EQ(format_of("dir.csv/a.dense.gz"), FileFormat::kDense);
  EXPECT_EQ(format_of("a.txt"), FileFormat::kDense);
  EXPECT_EQ(format_of("a.csv.gz"), FileFormat::kCsv);
  EXPECT_EQ(format_of("a.lp"), FileFormat::kLp);
  EXPECT_EQ(format_of("a.mps.gz"), FileFormat::kMps);
  EXPECT_EQ(format_of("-"), FileFormat::kNda);
  EXPECT_EQ(message_of([] { format_of("scan"); }),
            "cannot tell the format of 'scan' by its name, known are .nda, .csv, .dense, .txt, .lp "
            "and .mps");
  for (const char* name : {"nda", "dense", "csv", "lp", "mps", "auto"}) {
    EXPECT_STREQ(to_string(file_format(name)), name);
  }
  EXPECT_EQ(message_of([] { file_format("xls"); }),
            "unknown format 'xls', expected auto, nda, dense, csv, lp or mps");
}

TEST(Files, AreNamedInMessages) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.nda";
  EXPECT_EQ(message_of([&] { read_problem(path); }),
            path + ": cannot open: No such file or directory");
  write_file(path, "p nda 2 1 1 1\na 1 2 3\n");
  EXPECT_EQ(message_of([&] { read_problem(path); }),
            path + ": line 2: index 2 of dimension 2 exceeds 1");
  EXPECT_EQ(message_of([&] { read_problem(folder / "none"); }),
            (folder / "none") + ": cannot open: No such file or directory");
  EXPECT_EQ(message_of([&] { read_problem(folder / "."); }),
            (folder / ".") + ": cannot read: Is a directory");
  EXPECT_EQ(message_of([&] { read_problem(folder / ".", {FileFormat::kNda}); }),
            (folder / ".") + ": cannot read: Is a directory");
}

TEST(Files, AreReplacedAsAWholeOrNotAtAll) {
  const TemporaryFolder folder;
  const Problem problem = parse_problem(kText);
  write_file(folder / "a.nda", "old");
  EXPECT_EQ(message_of([&] { write_problem(problem, folder / "a.nda", {FileFormat::kDense}); }),
            (folder / "a.nda") + ": format dense can only be read");
  EXPECT_EQ(contents(folder / "a.nda"), "old");
  EXPECT_THAT(folder.files(), ElementsAre("a.nda"));
  write_problem(problem, folder / "a.nda");
  EXPECT_EQ(contents(folder / "a.nda"), kText);
  EXPECT_THAT(folder.files(), ElementsAre("a.nda"));
}

// A limit on the size of files makes the write fail in the middle.
TEST(Files, LeaveNothingBehindWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  ProblemBuilder builder({1000, 1000});
  for (Index i = 1; i <= 1000; ++i) {
    for (Index j = 1; j <= 100; ++j) builder.add_arc({i, j}, 0.1);
  }
  const Problem problem = std::move(builder).build();
  rlimit old_limit = {};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {100000, old_limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { write_problem(problem, folder / "a.nda"); });
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(message, (folder / "a.nda") + ": cannot write: File too large");
  EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(Files, AreWrittenThroughLinksWithTheModeTheyHad) {
  const TemporaryFolder folder;
  write_file(folder / "target.nda", "old");
  std::filesystem::permissions(folder / "target.nda", std::filesystem::perms(0640));
  std::filesystem::create_symlink(folder / "target.nda", folder / "link.nda");
  write_problem(parse_problem(kText), folder / "link.nda");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.nda"));
  EXPECT_EQ(contents(folder / "target.nda"), kText);
  EXPECT_EQ(std::filesystem::status(folder / "target.nda").permissions(),
            std::filesystem::perms(0640));
  EXPECT_THAT(folder.files(), UnorderedElementsAre("target.nda", "link.nda"));
}

TEST(Files, DevicesAreWrittenInPlace) {
  const Problem problem = parse_problem(kText);
  write_problem(problem, "/dev/null", {FileFormat::kNda});
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(message_of([&] { write_problem(problem, "/dev/full", {FileFormat::kNda}); }),
            "/dev/full: cannot write: No space left on device");
}

TEST(Files, ThatCannotBeWrittenAreNamed) {
  const TemporaryFolder folder;
  const Problem problem = parse_problem(kText);
  EXPECT_EQ(message_of([&] { write_problem(problem, folder / "no/a.nda"); }),
            (folder / "no/a.nda") + ": cannot write: No such file or directory");
  EXPECT_EQ(message_of([&] { write_problem(problem, folder / ".", {FileFormat::kNda}); }),
            (folder / ".") + ": cannot write: Is a directory");
}

TEST(Files, StartWithTheirComments) {
  WriteOptions options;
  options.comments = {"made by hand", "optimum -3.5"};
  std::ostringstream file;
  write_problem(parse_problem(kText), file, options);
  EXPECT_EQ(file.str(), "c made by hand\nc optimum -3.5\n" + kText);
  options.comments = {"one\ntwo"};
  EXPECT_THROW(write_problem(parse_problem(kText), file, options), InputError);
}

// Public instances that the repository does not hold: every arc file must be readable.
TEST(Files, OfTheSharedCollectionAreReadable) {
  const std::filesystem::path collection = NDA_SHARED_DATA "/arcs";
  if (!std::filesystem::is_directory(collection)) GTEST_SKIP() << collection << " is absent";
  int num_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(collection)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".nda") || path.ends_with(".nda.gz")) {
      EXPECT_NO_THROW(read_problem(path)) << path;
      ++num_files;
    }
  }
  EXPECT_GT(num_files, 0);
}

TEST(Files, RefuseAProblemThatWasMovedFrom) {
  const TemporaryFolder folder;
  Problem problem = parse_problem(kText);
  const Problem moved = std::move(problem);
  EXPECT_THROW(write_problem(problem, folder / "a.nda"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.nda"));
  std::ostringstream text;
  EXPECT_THROW(write_problem(problem, text), InputError);
  EXPECT_EQ(text.str(), "");
}

}  // namespace
}  // namespace nda::io
