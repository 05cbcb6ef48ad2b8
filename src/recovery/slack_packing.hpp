#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bnb/slack_search.hpp"

namespace nda::recovery {

/// A packing of a slack problem under change: who owns every index, how much of every row is left,
/// and the slack.  Prices must be finite.  Moves cost O(rows of the arc).
class SlackPacking {
 public:
  /// No arc.
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  /// Empty.  Keeps a reference to the problem.
  explicit SlackPacking(const bnb::SlackProblem& problem);

  bool is_index(std::uint32_t row) const { return row < problem_.num_indices(); }
  std::uint32_t owner(std::uint32_t index) const { return owner_[index]; }
  /// Capacity of a row that is not used, and what that costs.
  std::uint32_t left(std::uint32_t row) const { return left_[row]; }
  double unused(std::uint32_t row) const {
    return left_[row] == 0 ? 0.0 : problem_.price(row) * left_[row];
  }
  /// Of the packing: its reduced costs and what it leaves unused.
  double slack() const { return slack_; }

  /// No index of the arc is owned.
  bool fits(std::uint32_t arc) const;
  /// The arc must fit.
  void insert(std::uint32_t arc);
  /// The arc must be in.
  void remove(std::uint32_t arc);

  /// The arcs in, ascending.
  std::vector<std::uint32_t> arcs() const;
  void assign(std::span<const std::uint32_t> arcs);

 private:
  const bnb::SlackProblem& problem_;
  std::vector<std::uint32_t> owner_;  // [index]
  std::vector<std::uint32_t> left_;   // [row]
  double slack_ = 0;
};

}  // namespace nda::recovery
