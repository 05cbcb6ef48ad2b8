#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/lists.hpp"

namespace nda::recovery {

/// Which arcs of a slack problem exclude each other: what searches by swaps work on.
///
/// Holds the kMostArcs arcs of least reduced cost that save anything; others are numbers in that
/// list.  4 bytes for every pair that excludes each other, 4 MB at most.
class Rivals {
 public:
  static constexpr std::size_t kMostArcs = 1000;

  /// Prices must be finite.
  explicit Rivals(const bnb::SlackProblem& problem);

  std::uint32_t num_arcs() const { return static_cast<std::uint32_t>(arcs_.size()); }
  /// > 0: the prices of an arc's rows less its reduced cost, what it saves.
  double value(std::uint32_t n) const { return value_[n]; }
  std::span<const double> values() const { return value_; }
  /// The arcs that share an index with arc n.
  std::span<const std::uint32_t> operator[](std::uint32_t n) const { return lists_[n]; }
  /// The share of all pairs that exclude each other; 0 without arcs.
  double density() const;
  /// The arcs of the problem that these are, ascending.
  std::vector<std::uint32_t> arcs_of_problem(std::span<const std::uint32_t> numbers) const;
  /// What making it took, in the units of bnb::SlackLimits.
  double work() const { return work_; }

 private:
  void list_rivals(const bnb::SlackProblem& problem);

  std::vector<std::uint32_t> arcs_;  // ascending
  std::vector<double> value_;
  core::Lists<std::uint32_t> lists_;
  double work_ = 0;
};

}  // namespace nda::recovery
