#pragma once

#include "io/scanner.hpp"
#include "nda/io.hpp"
#include "nda/problem.hpp"

namespace nda::io {

// One reader per format.  Each consumes the whole source and throws InputError "line n: ...".

/// The project's own format: comments `c`, one line `p nda N M1..MN A`, A lines `a i1..iN cost`,
/// lines `b k i lo hi` with the bounds on the uses of an index.
Problem read_nda(Scanner& scanner, const ReadOptions& options);

/// `N s`, then s^N costs, last index fastest.  Singletons are forbidden: a perfect assignment.
Problem read_dense(Scanner& scanner, const ReadOptions& options);

/// A header row `i1,...,iN,cost`, then one row per arc.
Problem read_csv(Scanner& scanner, const ReadOptions& options);

/// Throws when the sizes ask for more memory than the file can justify, see
/// ReadOptions::spare_indices.
void check_sizes(const Scanner& scanner,
                 const ReadOptions& options,
                 const std::vector<Index>& sizes);

/// Throws when `num_items` things of at least `least_bytes` characters each cannot be in the file.
void check_backed(const Scanner& scanner,
                  std::uint64_t num_items,
                  std::size_t least_bytes,
                  const char* what);

/// Reads N, which must be within 2..kMaxDimensions.
int read_num_dimensions(Scanner& scanner);

/// Reads a whole number up to `largest`; the message calls it `what`.
std::uint64_t read_whole(Scanner& scanner, const std::string& what, std::uint64_t largest);

/// Reads a cost: finite or +inf.
double read_cost(Scanner& scanner);

/// Adds an arc; messages get the line.
inline void add_arc(ProblemBuilder& builder,
                    const Scanner& scanner,
                    std::span<const Index> tuple,
                    double cost) {
  try {
    builder.add_arc(tuple, cost);
  } catch (const InputError& error) {
    scanner.fail(error.what());
  }
}

}  // namespace nda::io
