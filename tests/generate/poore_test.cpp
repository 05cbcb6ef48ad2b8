#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "nda/generate.hpp"

namespace nda {
namespace {

int num_real(const std::vector<Index>& tuple) {
  return static_cast<int>(
      std::count_if(tuple.begin(), tuple.end(), [](Index i) { return i != 0; }));
}

TEST(PooreSparse, HasTheRequestedArcsAmongRealTuples) {
  PooreSparseOptions options;
  options.arcs = 3000;
  const Problem problem = generate_poore_sparse(options).problem;
  EXPECT_THAT(problem.sizes(), ::testing::ElementsAre(25, 25, 25, 25));
  EXPECT_EQ(problem.num_arcs(), 3000u);
  EXPECT_EQ(problem.num_duplicates(), 0u);
  double sum = 0;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    EXPECT_EQ(num_real(problem.arc(a)), 4);
    EXPECT_GE(problem.costs()[a], -100);
    EXPECT_LE(problem.costs()[a], -1);
    sum += problem.costs()[a];
  }
  EXPECT_NEAR(sum / 3000, -50.5, 2.7);  // five standard errors
  EXPECT_THAT(problem.singleton_costs(2), ::testing::Each(0));
}

TEST(PooreSparse, TakesEveryTupleIfAsked) {
  PooreSparseOptions options;
  options.dimensions = 3;
  options.min_size = options.max_size = 3;
  options.arcs = 27;
  EXPECT_EQ(generate_poore_sparse(options).problem.num_arcs(), 27u);
  options.arcs = 28;
  EXPECT_THROW(generate_poore_sparse(options), InputError);
}

TEST(PooreDense, HasTheExactShareOfTuplesAndAllSingletons) {
  const Problem problem = generate_poore_dense().problem;
  EXPECT_EQ(problem.num_arcs(), (8u * 8 * 8 * 8 - 1 - 28) / 4);
  int with_dummies = 0;
  for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
    EXPECT_GE(num_real(problem.arc(a)), 2);
    with_dummies += num_real(problem.arc(a)) < 4;
    EXPECT_GE(problem.costs()[a], 1);
    EXPECT_LE(problem.costs()[a], 100);
  }
  EXPECT_NEAR(with_dummies, 1016 * (4067 - 2401) / 4067.0, 75);
  for (int k = 0; k < 4; ++k) {
    for (Index i = 1; i <= 7; ++i) {
      EXPECT_GE(problem.singleton_costs(k)[i], 1);
      EXPECT_LE(problem.singleton_costs(k)[i], 100);
    }
  }
}

TEST(PooreDense, DrawsSizesFromTheirRange) {
  PooreDenseOptions options;
  options.min_size = 5;
  options.max_size = 9;
  Index least = 99, largest = 0;
  for (options.seed = 1; options.seed <= 20; ++options.seed) {
    const Problem problem = generate_poore_dense(options).problem;
    for (const Index size : problem.sizes()) {
      least = std::min(least, size);
      largest = std::max(largest, size);
    }
  }
  EXPECT_EQ(least, 5u);
  EXPECT_EQ(largest, 9u);
}

TEST(PooreDense, RejectsOptionsOutOfRange) {
  PooreDenseOptions options;
  options.share = 1.5;
  EXPECT_THROW(generate_poore_dense(options), InputError);
  options = {};
  options.min_size = 8;
  EXPECT_THROW(generate_poore_dense(options), InputError);
  options = {};
  options.dimensions = 1;
  EXPECT_THROW(generate_poore_dense(options), InputError);
  options.dimensions = 12;
  EXPECT_THROW(generate_poore_dense(options), InputError);
}

}  // namespace
}  // namespace nda
