#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>

#include "nda/generate.hpp"
#include "nda/io.hpp"

namespace nda {
namespace {

// FNV-1a, 64 bits, of the file as it is written.
std::uint64_t hash_of_file(const Instance& instance) {
  WriteOptions options;
  options.comments = instance.comments;
  std::ostringstream file;
  write_problem(instance.problem, file, options);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : file.str()) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return hash;
}

// Files are the same on every platform and in every version: a change here breaks every published
// result on generated files.
TEST(GeneratedFile, IsTheSameEverywhere) {
  EXPECT_EQ(hash_of_file(generate_poore_sparse()), 0x5458bdd750adc40fu);
  EXPECT_EQ(hash_of_file(generate_poore_dense()), 0x958cdae43a5b00dcu);
  EXPECT_EQ(hash_of_file(generate_map3()), 0xa9a488f3a97108aeu);
  EXPECT_EQ(hash_of_file(generate_planted()), 0xbf2cffac9239bc16u);
  EXPECT_EQ(hash_of_file(generate_gadgets()), 0x95a7f63a39ce95d8u);
  EXPECT_EQ(hash_of_file(generate_bounded()), 0xc21570a4a1a4c8d8u);
  EXPECT_EQ(hash_of_file(generate_merged()), 0x4e409a55a0403127u);
  EXPECT_EQ(hash_of_file(generate_tracking(tracking_preset("small"))), 0xdcd1994640580328u);
  EXPECT_EQ(hash_of_file(generate_tracking(tracking_preset("hard6"))), 0xf1d6678d29dc967au);
  EXPECT_EQ(hash_of_file(generate_tracking(tracking_preset("six-scan"))), 0x098b94afbbb1ef84u);
}

TEST(GeneratedFile, DependsOnTheSeed) {
  PooreSparseOptions options;
  options.seed = 2;
  EXPECT_NE(hash_of_file(generate_poore_sparse(options)), hash_of_file(generate_poore_sparse()));
  TrackingOptions tracking;
  tracking.seed = 2;
  EXPECT_NE(hash_of_file(generate_tracking(tracking)), hash_of_file(generate_tracking()));
}

TEST(GeneratedFile, ReadsBackToTheSameProblem) {
  const Instance instance = generate_tracking();
  WriteOptions options;
  options.comments = instance.comments;
  std::stringstream file;
  write_problem(instance.problem, file, options);
  const Problem again = read_problem(file);
  ASSERT_EQ(again.num_arcs(), instance.problem.num_arcs());
  for (std::size_t a = 0; a < again.num_arcs(); ++a) {
    EXPECT_EQ(again.arc(a), instance.problem.arc(a));
    EXPECT_EQ(again.costs()[a], instance.problem.costs()[a]);
  }
}

}  // namespace
}  // namespace nda
