#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/fuzz_targets.hpp"
#include "fuzz/mutator.hpp"
#include "nda/io.hpp"

namespace nda::fuzz {
namespace {

std::vector<std::string> seeds_of(const Target& target) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(NDA_FUZZ_CORPUS) / target.name)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Readers : public ::testing::TestWithParam<Target> {};

TEST_P(Readers, AcceptTheirSeeds) {
  const std::vector<std::string> seeds = seeds_of(GetParam());
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) EXPECT_TRUE(GetParam().run(seed));
}

// An input that was accepted is changed further, so that changes add up.
TEST_P(Readers, KeepTheirPromisesForMutatedInputs) {
  constexpr int kTrials = 20000;
  constexpr std::size_t kPoolSize = 200;
  constexpr std::size_t kLongest = 4000;
  const std::vector<std::string> seeds = seeds_of(GetParam());
  std::vector<std::string> pool = seeds;
  core::Random random(2026);
  int num_accepted = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::string input = mutated(pool[random.below(pool.size())], seeds, random);
    bool accepted = false;
    ASSERT_NO_THROW(accepted = GetParam().run(input))
        << "trial " << trial << ", input " << ::testing::PrintToString(input);
    num_accepted += accepted ? 1 : 0;
    if (!accepted || input.size() > kLongest) continue;
    if (pool.size() < kPoolSize) {
      pool.push_back(std::move(input));
    } else {
      pool[seeds.size() + random.below(kPoolSize - seeds.size())] = std::move(input);
    }
  }
  EXPECT_GT(num_accepted, kTrials / 100);
  EXPECT_LT(num_accepted, kTrials / 2);
  RecordProperty("accepted", num_accepted);
}

std::string name_of(const ::testing::TestParamInfo<Target>& parameter) {
  return parameter.param.name;
}

INSTANTIATE_TEST_SUITE_P(Fuzz,
                         Readers,
                         ::testing::ValuesIn(targets().begin(), targets().end()),
                         name_of);

}  // namespace
}  // namespace nda::fuzz
