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

/// Columns are handled in blocks of so many; the least distance of each is kept.
inline constexpr std::uint32_t kBlock = 64;

/// One step of Dijkstra on a line: distance[j] = min(distance[j], c[j] - price[j] + offset), and
/// from[j] = member wherever that is new; block_least[b] = least distance of block b.
///
/// All arrays have num_blocks * kBlock entries but c, which has n; the surplus distances are +inf.
/// `from` is double for the sake of vector units, which then treat all arrays alike.
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
