#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <sstream>

#include "io/io_support.hpp"
#include "io/sink.hpp"
#include "io/source.hpp"
#include "nda/io.hpp"

namespace nda::io {
namespace {

const std::string kText = "p nda 2 2 2 2\na 1 1 4\na 2 2 -3.5\n";

std::string compressed(std::string_view text) {
  std::ostringstream bytes;
  const auto sink = gzip_sink(stream_sink(bytes));
  sink->write(text);
  sink->commit();
  return bytes.str();
}

std::string decompressed_text(const std::string& bytes) {
  const auto source = decompressed(memory_source(bytes));
  std::string text;
  char block[1000];
  for (std::size_t count = 0; (count = source->read(block, sizeof block)) > 0;) {
    text.append(block, count);
  }
  return text;
}

std::string error(const std::string& bytes) {
  return message_of([&] { parse_problem(bytes); });
}

TEST(Gzip, RestoresContentOfEverySize) {
  for (const std::size_t size : {0, 1, 2, 1000, 131072, 1000003}) {
    std::string text(size, '\0');
    core::Random random(size);
    for (char& c : text) c = static_cast<char>(random.below(7));
    EXPECT_EQ(decompressed_text(compressed(text)), text) << size;
  }
}

TEST(Gzip, IsReadLikePlainText) {
  EXPECT_TRUE(same_problem(parse_problem(compressed(kText)), parse_problem(kText)));
}

TEST(Gzip, IsReadWhenMembersAreConcatenatedAnywhere) {
  for (std::size_t cut = 0; cut <= kText.size(); ++cut) {
    const std::string bytes = compressed(kText.substr(0, cut)) + compressed(kText.substr(cut));
    ASSERT_TRUE(same_problem(parse_problem(bytes), parse_problem(kText))) << cut;
  }
}

TEST(Gzip, RefusesEveryTruncation) {
  const std::string bytes = compressed(kText);
  for (std::size_t size = 2; size < bytes.size(); ++size) {
    ASSERT_EQ(error(bytes.substr(0, size)), "line 1: gzip data ends too early") << size;
  }
}

TEST(Gzip, RefusesGarbageBehindTheData) {
  for (const char* garbage : {"x", "\x1f", "\x1f\x1f", "garbage"}) {
    EXPECT_EQ(error(compressed(kText) + garbage), "line 1: garbage follows the gzip data");
  }
  EXPECT_EQ(error(compressed(kText) + std::string(1, '\0')),
            "line 1: garbage follows the gzip data");
}

TEST(Gzip, RefusesCorruptData) {
  std::string bytes = compressed(kText);
  bytes[bytes.size() - 6] ^= 1;
  EXPECT_EQ(error(bytes), "line 1: gzip data is corrupt: incorrect data check");
  bytes[2] = 7;
  EXPECT_EQ(error(bytes), "line 1: gzip data is corrupt: unknown compression method");
}

TEST(Gzip, NamesTheLineWhereTheDataBreaks) {
  std::string text = "p nda 2 1 1 100000\n";
  for (int line = 0; line < 100000; ++line) text += "a 1 1 4\n";
  const std::string bytes = compressed(text);
  EXPECT_THAT(error(bytes.substr(0, bytes.size() - 1)),
              ::testing::MatchesRegex("line [1-9][0-9][0-9][0-9][0-9]+: gzip data ends too early"));
}

// A kilobyte that expands a thousandfold is read in pieces; what it may claim is bounded.
TEST(Gzip, BoundsClaimsByTheLargestExpansion) {
  const std::string bytes = compressed("p nda 2 1 1 4000000000\n");
  EXPECT_EQ(error(bytes),
            "line 1: 4000000000 arcs announced, too many for a file of at most 23 bytes");
  const std::string large = compressed("p nda 2 1 1 4000000000\nc" + std::string(500000, ' '));
  EXPECT_EQ(error(large),
            "line 1: 4000000000 arcs announced, too many for a file of at most " +
                std::to_string(1032 * large.size()) + " bytes");
}

}  // namespace
}  // namespace nda::io
