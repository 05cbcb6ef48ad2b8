#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nda::lap {

/// The two least of c[j] - price[j] over a line, and where the least is (the first such j).
struct LineOffers {
  double first;
  double second;
  std::uint32_t at;
};

/// +inf and kNone where there are not so many.  @param c, price  n entries.
LineOffers line_offers(const double* c, const double* price, std::uint32_t n);

/// Columns are handled in blocks of so many.
inline constexpr std::uint32_t kBlock = 32;

inline constexpr std::size_t num_blocks(std::size_t n) {
  return (n + kBlock - 1) / kBlock;
}

/// The least c[j] - price[j]; +inf if n = 0.
/// @param block_least  num_blocks(n) entries: the same of each block.
double line_least(const double* c, const double* price, std::uint32_t n, double* block_least);

/// The same without the blocks.
double line_least(const double* c, const double* price, std::uint32_t n);

/// bound[j] = min(bound[j], c[j] - potential).
void lower_line(const double* c, double potential, std::uint32_t n, double* bound);

/// One step of Dijkstra on a line: distance[j] = min(distance[j], c[j] - price[j] + offset), and
/// from[j] = member wherever that is new.
///
/// `from` is double for the sake of vector units, which then treat all arrays alike.
/// @param block_least  num_blocks(n) entries: the least distance of each block.
/// @return the least distance.
double relax_line(const double* c,
                  const double* price,
                  double offset,
                  double member,
                  std::uint32_t n,
                  double* distance,
                  double* from,
                  double* block_least);

/// out[j * num_rows + i] = in[i * num_columns + j].
void transpose_matrix(std::span<const double> in,
                      std::size_t num_rows,
                      std::size_t num_columns,
                      std::span<double> out);

}  // namespace nda::lap
