#include "core/loads.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nda::core {
namespace {

TEST(TwoIndices, ComeInOrder) {
  const std::vector<Index> indices{7, 0, 0xffffffffu, 5};
  EXPECT_EQ(two_indices(indices.data()), std::pair(Index{7}, Index{0}));
  EXPECT_EQ(two_indices(indices.data() + 1), std::pair(Index{0}, Index{0xffffffffu}));
  EXPECT_EQ(two_indices(indices.data() + 2), std::pair(Index{0xffffffffu}, Index{5}));
}

TEST(Prefetch, MayAskForWhatIsNotThere) {
  const std::vector<double> one{1.0};
  prefetch(one.data(), std::size_t{1} << 40);
  EXPECT_EQ(one.front(), 1.0);
}

}  // namespace
}  // namespace nda::core
