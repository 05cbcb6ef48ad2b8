#include "assign2d/dense_kernels.hpp"

#include <algorithm>

#include "assign2d/side.hpp"
#include "nda/types.hpp"

// Plain loops over eight independent lanes: compilers turn them into vector instructions of
// whatever width the target has, without reassociating anything, so that every target computes the
// same numbers.

namespace nda::lap {
namespace {

constexpr std::uint32_t kLanes = 8;

struct Lanes {
  double first[kLanes];
  double second[kLanes];
};

inline void add_offer(double offer, double& first, double& second) {
  const double larger = offer < first ? first : offer;
  first = offer < first ? offer : first;
  second = larger < second ? larger : second;
}

std::uint32_t find_offer(const double* c, const double* price, std::uint32_t n, double offer) {
  std::uint32_t j = 0;
  while (j < n && c[j] - price[j] != offer) ++j;
  return j < n ? j : kNone;
}

double relax_block(const double* __restrict c,
                   const double* __restrict price,
                   double offset,
                   double member,
                   double* __restrict distance,
                   double* __restrict from) {
  double least[kLanes];
  for (double& x : least) x = kInfinity;
  for (std::uint32_t j = 0; j < kBlock; j += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const double old = distance[j + lane];
      const double reach = c[j + lane] - price[j + lane] + offset;
      const double now = reach < old ? reach : old;
      from[j + lane] = reach < old ? member : from[j + lane];
      distance[j + lane] = now;
      least[lane] = now < least[lane] ? now : least[lane];
    }
  }
  return *std::min_element(least, least + kLanes);
}

}  // namespace

LineOffers line_offers(const double* c, const double* price, std::uint32_t n) {
  Lanes lanes;
  std::fill_n(lanes.first, kLanes, kInfinity);
  std::fill_n(lanes.second, kLanes, kInfinity);
  std::uint32_t j = 0;
  for (; j + kLanes <= n; j += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      add_offer(c[j + lane] - price[j + lane], lanes.first[lane], lanes.second[lane]);
    }
  }
  LineOffers offers{kInfinity, kInfinity, kNone};
  for (; j < n; ++j) add_offer(c[j] - price[j], offers.first, offers.second);
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    add_offer(lanes.first[lane], offers.first, offers.second);
    offers.second = std::min(offers.second, lanes.second[lane]);
  }
  if (offers.first < kInfinity) offers.at = find_offer(c, price, n, offers.first);
  return offers;
}

double line_least(const double* c, const double* price, std::uint32_t n, double* block_least) {
  double least = kInfinity;
  for (std::uint32_t begin = 0; begin < n; begin += kBlock) {
    const double in_block = line_least(c + begin, price + begin, std::min(kBlock, n - begin));
    block_least[begin / kBlock] = in_block;
    least = in_block < least ? in_block : least;
  }
  return least;
}

double line_least(const double* c, const double* price, std::uint32_t n) {
  double least[kLanes];
  std::fill_n(least, kLanes, kInfinity);
  std::uint32_t j = 0;
  for (; j + kLanes <= n; j += kLanes) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const double offer = c[j + lane] - price[j + lane];
      least[lane] = offer < least[lane] ? offer : least[lane];
    }
  }
  for (; j < n; ++j) least[0] = std::min(least[0], c[j] - price[j]);
  return *std::min_element(least, least + kLanes);
}

void lower_line(const double* __restrict c,
                double potential,
                std::uint32_t n,
                double* __restrict bound) {
  for (std::uint32_t j = 0; j < n; ++j) {
    const double offer = c[j] - potential;
    bound[j] = offer < bound[j] ? offer : bound[j];
  }
}

double relax_line(const double* c,
                  const double* price,
                  double offset,
                  double member,
                  std::uint32_t n,
                  double* distance,
                  double* from,
                  double* block_least) {
  double least = kInfinity;
  std::uint32_t j = 0;
  for (; j + kBlock <= n; j += kBlock) {
    const double in_block = relax_block(c + j, price + j, offset, member, distance + j, from + j);
    block_least[j / kBlock] = in_block;
    least = in_block < least ? in_block : least;
  }
  if (j == n) return least;
  double in_block = kInfinity;
  const std::uint32_t last = j / kBlock;
  for (; j < n; ++j) {
    const double reach = c[j] - price[j] + offset;
    if (reach < distance[j]) {
      distance[j] = reach;
      from[j] = member;
    }
    in_block = distance[j] < in_block ? distance[j] : in_block;
  }
  block_least[last] = in_block;
  return in_block < least ? in_block : least;
}

void transpose_matrix(std::span<const double> in,
                      std::size_t num_rows,
                      std::size_t num_columns,
                      std::span<double> out) {
  constexpr std::size_t kTile = 32;  // two tiles of doubles lie in the first-level cache
  for (std::size_t i0 = 0; i0 < num_rows; i0 += kTile) {
    const std::size_t i1 = std::min(i0 + kTile, num_rows);
    for (std::size_t j0 = 0; j0 < num_columns; j0 += kTile) {
      const std::size_t j1 = std::min(j0 + kTile, num_columns);
      for (std::size_t i = i0; i < i1; ++i) {
        for (std::size_t j = j0; j < j1; ++j) out[j * num_rows + i] = in[i * num_columns + j];
      }
    }
  }
}

}  // namespace nda::lap
