#include "nda/problem.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random.hpp"

namespace nda {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ProblemBuilder, SortsArcsLexicographically) {
  ProblemBuilder builder({2, 2, 2});
  builder.add_arc({2, 1, 0}, 3);
  builder.add_arc({1, 2, 2}, 1);
  builder.add_arc({1, 0, 2}, 2);
  const Problem problem = std::move(builder).build();
  EXPECT_THAT(problem.indices(0), ElementsAre(1, 1, 2));
  EXPECT_THAT(problem.indices(1), ElementsAre(0, 2, 1));
  EXPECT_THAT(problem.costs(), ElementsAre(2, 1, 3));
  EXPECT_EQ(problem.num_indices(), 6u);
}

TEST(ProblemBuilder, KeepsTheCheapestOfEqualTuples) {
  ProblemBuilder builder({1, 1});
  for (const double cost : {4.0, -2.0, 7.0}) builder.add_arc({1, 1}, cost);
  for (const double cost : {5.0, 3.0}) builder.add_arc({0, 1}, cost);
  const Problem problem = std::move(builder).build();
  EXPECT_THAT(problem.costs(), ElementsAre(-2));
  EXPECT_EQ(problem.num_duplicates(), 3u);
  EXPECT_THAT(problem.singleton_costs(0), ElementsAre(0, 0));
  EXPECT_THAT(problem.singleton_costs(1), ElementsAre(0, 3));
}

TEST(ProblemBuilder, SortsAndMergesLikeAMapOfTuples) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    core::Random random(seed);
    const std::vector<Index> sizes = {3, 40, 1, 7};
    std::map<std::vector<Index>, double> expected;
    ProblemBuilder builder(sizes);
    for (int a = 0; a < 300; ++a) {
      std::vector<Index> tuple;
      for (const Index size : sizes) tuple.push_back(static_cast<Index>(random.below(size + 1)));
      if (std::count(tuple.begin(), tuple.end(), 0u) > 2) continue;
      const double cost = std::floor(random.uniform(0, 5));
      builder.add_arc(tuple, cost);
      const auto [place, is_new] = expected.try_emplace(tuple, cost);
      if (!is_new) place->second = std::min(place->second, cost);
    }
    const Problem problem = std::move(builder).build();
    ASSERT_EQ(problem.num_arcs(), expected.size());
    std::size_t a = 0;
    for (const auto& [tuple, cost] : expected) {
      EXPECT_EQ(problem.arc(a), tuple);
      EXPECT_EQ(problem.costs()[a], cost);
      ++a;
    }
  }
}

TEST(ProblemBuilder, DropsForbiddenArcsAndKeepsForbiddenSingletons) {
  ProblemBuilder builder({1, 1});
  builder.add_arc({1, 1}, kInfinity);
  builder.add_arc({1, 0}, kInfinity);
  const Problem problem = std::move(builder).build();
  EXPECT_EQ(problem.num_arcs(), 0u);
  EXPECT_EQ(problem.num_forbidden(), 1u);
  EXPECT_EQ(problem.singleton_costs(0)[1], kInfinity);
}

TEST(ProblemBuilder, NamesWhatIsWrong) {
  ProblemBuilder builder({3, 7});
  EXPECT_THAT(message_of([&] {
                builder.add_arc({1, 9}, 0);
              }),
              HasSubstr("index 9 of dimension 2 exceeds 7"));
  EXPECT_THAT(message_of([&] { builder.add_arc({1, 2, 3}, 0); }), HasSubstr("tuple has 3 indices"));
  EXPECT_THAT(message_of([&] { builder.add_arc({0, 0}, 0); }), HasSubstr("all indices"));
  EXPECT_THAT(message_of([&] { builder.add_arc({1, 1}, std::nan("")); }), HasSubstr("NaN"));
  EXPECT_THAT(message_of([&] { builder.add_arc({1, 1}, -kInfinity); }), HasSubstr("-inf"));
  EXPECT_THAT(message_of([] { ProblemBuilder({5}); }), HasSubstr("1 dimensions"));
  EXPECT_EQ(builder.num_arcs(), 0u);
}

TEST(ProblemBuilder, GivesItsProblemAwayOnce) {
  ProblemBuilder builder({1, 1});
  const Problem problem = std::move(builder).build();
  EXPECT_EQ(problem.num_dimensions(), 2);
  EXPECT_THAT(message_of([&] { std::move(builder).build(); }), HasSubstr("given its problem away"));
  EXPECT_THROW(builder.add_arc({1, 1}, 1), InputError);
}

TEST(Problem, FindsArcsByTuple) {
  ProblemBuilder builder({2, 2, 2});
  builder.add_arc({1, 0, 2}, 2);
  builder.add_arc({1, 2, 2}, 1);
  const Problem problem = std::move(builder).build();
  EXPECT_EQ(problem.find(std::vector<Index>{1, 2, 2}), 1u);
  EXPECT_EQ(problem.find(std::vector<Index>{1, 2, 1}), std::nullopt);
  EXPECT_EQ(problem.find(std::vector<Index>{1, 2}), std::nullopt);
  EXPECT_THAT(problem.arc(0), ElementsAre(1, 0, 2));
}

}  // namespace
}  // namespace nda
