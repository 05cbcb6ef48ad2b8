#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "assign2d/dense_kernels.hpp"
#include "assign2d/instances.hpp"
#include "assign2d/quad_heap.hpp"
#include "assign2d/transpose.hpp"

// The parts that the solvers are made of.

namespace nda::lap {
namespace {

using support::below;
using support::from_matrix;
using support::kAbsent;
using support::OwnedProblem;
using support::Random;
using support::uniform;
using ::testing::ElementsAre;

TEST(QuadHeap, PopsKeysInOrderAlsoAfterDecreases) {
  Random random(1);
  QuadHeap heap;
  for (int n = 0; n < 50; ++n) {
    SCOPED_TRACE("heap " + std::to_string(n));
    heap.resize(40);
    std::vector<double> key(40);
    for (std::uint32_t i = 0; i < 40; ++i) heap.push_or_decrease(i, key[i] = uniform(random));
    for (int step = 0; step < 60; ++step) {
      const std::uint32_t i = below(random, 40);
      heap.push_or_decrease(i, key[i] *= uniform(random));
    }
    std::vector<double> popped;
    for (int step = 0; step < 30; ++step) {
      const double least = heap.top_key();
      const std::uint32_t top = heap.pop();
      EXPECT_FALSE(heap.contains(top));
      popped.push_back(key[top]);
      EXPECT_EQ(popped.back(), least);
    }
    EXPECT_TRUE(std::is_sorted(popped.begin(), popped.end()));
    std::sort(key.begin(), key.end());
    EXPECT_TRUE(std::equal(popped.begin(), popped.end(), key.begin()));
  }
}

//      5 -     Columns hold rows 0, 2 and rows 1, 2 with pairs 0, 2 and 1, 3.
//      - 6
//      7 8
TEST(Transpose, ListsPairsByColumn) {
  const OwnedProblem problem = from_matrix({{5, kAbsent}, {kAbsent, 6}, {7, 8}}, {0, 0, 0}, {0, 0});
  Transpose transpose;
  const ColumnView view = transpose.view(problem.view());
  EXPECT_THAT(view.start, ElementsAre(0, 2, 4));
  EXPECT_THAT(view.partner, ElementsAre(0, 2, 1, 2));
  EXPECT_THAT(view.entry, ElementsAre(0, 2, 1, 3));
  EXPECT_EQ(view.cost(1), 7);
}

TEST(Transpose, NoticesAnotherPattern) {
  Transpose transpose;
  transpose.view(from_matrix({{1, kAbsent}}, {0}, {0, 0}).view());
  const OwnedProblem other = from_matrix({{kAbsent, 2}}, {0}, {0, 0});
  EXPECT_THAT(transpose.view(other.view()).start, ElementsAre(0, 0, 1));
  const OwnedProblem wider = from_matrix({{kAbsent, 2, kAbsent}}, {0}, {0, 0, 0});
  EXPECT_THAT(transpose.view(wider.view()).start, ElementsAre(0, 0, 1, 1));
}

class DenseKernels : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  DenseKernels() {
    Random random(GetParam());
    for (std::uint32_t j = 0; j < n_; ++j) {
      cost_.push_back(below(random, 5) == 0 ? kInfinity : 10 * uniform(random));
      price_.push_back(uniform(random));
    }
  }

  std::uint32_t n_ = GetParam();  // around lanes and blocks
  std::vector<double> cost_, price_;
};

INSTANTIATE_TEST_SUITE_P(Widths, DenseKernels, ::testing::Values(0, 1, 7, 8, 9, 31, 32, 33, 100));

TEST_P(DenseKernels, FindTheTwoBestOffers) {
  std::vector<double> offers = {kInfinity, kInfinity};
  for (std::uint32_t j = 0; j < n_; ++j) offers.push_back(cost_[j] - price_[j]);
  const LineOffers best = line_offers(cost_.data(), price_.data(), n_);
  if (best.at != kNone) {
    EXPECT_EQ(offers[best.at + 2], best.first);
  }
  std::sort(offers.begin(), offers.end());
  EXPECT_EQ(best.first, offers[0]);
  EXPECT_EQ(best.second, offers[1]);
  EXPECT_EQ(best.at == kNone, offers[0] == kInfinity);
  std::vector<double> block_least(num_blocks(n_));
  EXPECT_EQ(line_least(cost_.data(), price_.data(), n_, block_least.data()), offers[0]);
  if (n_ > 0) {
    EXPECT_EQ(*std::min_element(block_least.begin(), block_least.end()), offers[0]);
  }
}

TEST_P(DenseKernels, RelaxALine) {
  std::vector<double> distance(n_, 4), from(n_, 1), block_least(num_blocks(n_));
  const double least = relax_line(
      cost_.data(), price_.data(), 0.5, 7, n_, distance.data(), from.data(), block_least.data());
  double expected_least = kInfinity;
  for (std::uint32_t j = 0; j < n_; ++j) {
    const double reach = cost_[j] - price_[j] + 0.5;
    EXPECT_EQ(distance[j], std::min(4.0, reach));
    EXPECT_EQ(from[j], reach < 4 ? 7 : 1);
    EXPECT_LE(block_least[j / kBlock], distance[j]);
    expected_least = std::min(expected_least, distance[j]);
  }
  EXPECT_EQ(least, expected_least);
}

TEST(TransposeMatrix, SwapsRowsAndColumns) {
  const std::size_t num_rows = 35, num_columns = 70;
  std::vector<double> in(num_rows * num_columns), out(in.size());
  for (std::size_t k = 0; k < in.size(); ++k) in[k] = static_cast<double>(k);
  transpose_matrix(in, num_rows, num_columns, out);
  for (std::size_t i = 0; i < num_rows; ++i) {
    for (std::size_t j = 0; j < num_columns; ++j) {
      ASSERT_EQ(out[j * num_rows + i], in[i * num_columns + j]);
    }
  }
}

}  // namespace
}  // namespace nda::lap
