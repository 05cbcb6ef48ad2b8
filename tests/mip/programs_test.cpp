#include "mip/programs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mip_support.hpp"

namespace nda::mip {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Programs, AreFoundInTheOrderOfThePathEachOnce) {
  const Scratch first;
  const Scratch second;
  first.add_program("tool", "");
  second.add_program("tool", "");
  const std::string path = second.path() + ":/no/such:" + first.path() + ":" + second.path();
  EXPECT_THAT(find_programs("tool", path), ElementsAre(second.file("tool"), first.file("tool")));
  EXPECT_EQ(find_program("tool", path), second.file("tool"));
}

TEST(Programs, MustBeExecutableFiles) {
  const Scratch scratch;
  std::ofstream(scratch.file("text")) << "no program";
  std::filesystem::create_directory(scratch.file("folder"));
  EXPECT_THAT(find_programs("text", scratch.path()), IsEmpty());
  EXPECT_THAT(find_programs("folder", scratch.path()), IsEmpty());
  EXPECT_FALSE(find_program("absent", scratch.path()));
}

TEST(Programs, AreNotLookedForInRelativeFolders) {
  EXPECT_THAT(find_programs("sh", ".::bin:../bin"), IsEmpty());
}

}  // namespace
}  // namespace nda::mip
