#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "nda/assign2d.hpp"

// Namespace lap (linear assignment problem): a namespace assign2d would clash with the function.
namespace nda::lap {

/// No member, no pair.
inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

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
  template <class Action>
  void for_each_pair(std::uint32_t i, const Action& action) const {
    for (std::uint32_t k = start[i]; k < start[i + 1]; ++k) action(partner[k], costs[k]);
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
  template <class Action>
  void for_each_pair(std::uint32_t i, const Action& action) const {
    const double* cost = line(i);
    for (std::uint32_t j = 0; j < width; ++j) action(j, cost[j]);
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
