#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "assign2d/dense_kernels.hpp"
#include "nda/assign2d.hpp"

// Namespace lap (linear assignment problem): a namespace assign2d would clash with the function.
namespace nda::lap {

/// No member, no pair.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The pair of a row and a column of a problem's rows, kNone if there is none; looks at `guess`
/// first, any number.
inline std::uint32_t find_pair(std::span<const std::uint32_t> row_start,
                               std::span<const std::uint32_t> column,
                               std::uint32_t row,
                               std::uint32_t wanted,
                               std::uint32_t guess) {
  const std::uint32_t first = row_start[row];
  const std::uint32_t last = row_start[row + 1];
  if (guess >= first && guess < last && column[guess] == wanted) return guess;
  const auto end = column.begin() + last;
  const auto found = std::lower_bound(column.begin() + first, end, wanted);
  if (found == end || *found != wanted) return kNone;
  return static_cast<std::uint32_t>(found - column.begin());
}

/// Rows or columns: what both phases of a two-sided algorithm need of a side.
///
/// Rows first look for columns, then the columns still in want look for rows with the very same
/// code.
struct Side {
  std::span<const double> outside;  ///< +inf = must be assigned
  std::span<double> dual;           ///< at most outside
  std::span<std::int32_t> mate;     ///< on the other side, or kUnassigned

  std::uint32_t size() const { return static_cast<std::uint32_t>(outside.size()); }
  bool is_free(std::uint32_t i) const { return mate[i] == kUnassigned; }
  /// Unassigned although its outside option costs more than its dual: slackness is broken.
  bool in_want(std::uint32_t i) const { return is_free(i) && dual[i] < outside[i]; }
};

inline bool anyone_in_want(const Side& side) {
  for (std::uint32_t i = 0; i < side.size(); ++i) {
    if (side.in_want(i)) return true;
  }
  return false;
}

inline Side row_side(const Assign2dProblem& problem, Assign2dResult& result) {
  return {problem.row_outside, result.u, result.column_of_row};
}

inline Side column_side(const Assign2dProblem& problem, Assign2dResult& result) {
  return {problem.column_outside, result.v, result.row_of_column};
}

/// The pairs as rows see them: pair k of row i is number k in the problem.
struct RowView {
  std::span<const std::uint32_t> start;
  std::span<const std::uint32_t> partner;
  std::span<const double> costs;

  double cost(std::uint32_t k) const { return costs[k]; }
  std::uint32_t pair(std::uint32_t k) const { return k; }
  /// The least c_ij - price_j of member i; +inf if it has no pairs.
  double least_offer(std::uint32_t i, std::span<const double> price) const {
    double least = kInfinity;
    for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) {
      const double offer = costs[k] - price[partner[k]];
      least = offer < least ? offer : least;
    }
    return least;
  }
  /// bound_j = min(bound_j, c_ij - potential) over the pairs of member i.
  void lower_bounds(std::uint32_t i, double potential, std::span<double> bound) const {
    for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) {
      const double offer = costs[k] - potential;
      if (offer < bound[partner[k]]) bound[partner[k]] = offer;
    }
  }
  static std::uint32_t row(std::uint32_t own, std::uint32_t /*other*/) { return own; }
};

/// The pairs as columns see them: pair k of column j is number entry[k] in the problem.
struct ColumnView {
  std::span<const std::uint32_t> start;
  std::span<const std::uint32_t> partner;
  std::span<const std::uint32_t> entry;
  std::span<const double> costs;

  double cost(std::uint32_t k) const { return costs[entry[k]]; }
  std::uint32_t pair(std::uint32_t k) const { return entry[k]; }
  static std::uint32_t row(std::uint32_t /*own*/, std::uint32_t other) { return other; }
};

/// A full matrix, one line of `width` costs for each member of the side that looks.
struct DenseView {
  const double* costs;
  std::size_t width;

  const double* line(std::uint32_t i) const { return costs + i * width; }
  double least_offer(std::uint32_t i, std::span<const double> price) const {
    return line_least(line(i), price.data(), static_cast<std::uint32_t>(width));
  }
  void lower_bounds(std::uint32_t i, double potential, std::span<double> bound) const {
    lower_line(line(i), potential, static_cast<std::uint32_t>(width), bound.data());
  }
};

/// One phase of an algorithm on a sparse problem: `own` looks for partners among `other`.
template <class View>
struct Phase {
  View view;
  Side own;
  Side other;
  std::span<std::uint32_t>
      pair_of_row;  ///< number of the chosen pair in the problem, where assigned

  /// Chooses pair k of i, which belongs to j.  Former mates are the caller's business.
  void match(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    own.mate[i] = static_cast<std::int32_t>(j);
    other.mate[j] = static_cast<std::int32_t>(i);
    pair_of_row[View::row(i, j)] = view.pair(k);
  }
};

}  // namespace nda::lap
