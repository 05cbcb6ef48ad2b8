#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/for_all.hpp"
#include "nda/solution.hpp"
#include "nda/types.hpp"

namespace nda::bnb {

/// An arc's coefficient in a row, 1 or more.
struct RowUse {
  std::uint32_t row;
  std::uint32_t coefficient;
};

/// A packing problem as its multipliers leave it: with u and the multipliers of cuts, the cost of a
/// packing is a constant plus
///
///     sum over its arcs of reduced cost + sum over rows of price * capacity left unused,
///
/// the *slack* of the packing, a sum of non-negative terms.  Rows are indices and cuts; the price
/// of a row is minus its multiplier.  Cuts hold for every packing: arcs that share no index fill no
/// row beyond its capacity.
class SlackProblem {
 public:
  /// @param num_indices  the rows of that many numbers are indices: no two arcs share one.
  explicit SlackProblem(std::uint32_t num_indices) : num_indices_(num_indices) {}

  /// Makes room for so many rows, arcs, and uses of all arcs.
  void reserve(std::size_t rows, std::size_t arcs, std::size_t uses);
  /// Indices first.  price >= 0, +inf = must be used up.  Returns its number.
  std::uint32_t add_row(double price, std::uint32_t capacity = 1);
  /// reduced >= 0; uses of indices before those of cuts.  Returns its number.
  std::uint32_t add_arc(double reduced, std::span<const RowUse> uses);

  std::uint32_t num_indices() const { return num_indices_; }
  std::uint32_t num_rows() const { return static_cast<std::uint32_t>(price_.size()); }
  std::uint32_t num_arcs() const { return static_cast<std::uint32_t>(reduced_.size()); }
  double price(std::uint32_t row) const { return price_[row]; }
  std::uint32_t capacity(std::uint32_t row) const { return capacity_[row]; }
  double reduced(std::uint32_t arc) const { return reduced_[arc]; }
  std::span<const RowUse> uses(std::uint32_t arc) const {
    return std::span(uses_).subspan(start_[arc], start_[arc + 1] - start_[arc]);
  }
  /// Those of indices.
  std::span<const RowUse> index_uses(std::uint32_t arc) const {
    return std::span(uses_).subspan(start_[arc], num_index_uses_[arc]);
  }

 private:
  std::uint32_t num_indices_;
  std::vector<double> price_;            // [row]
  std::vector<std::uint32_t> capacity_;  // [row]
  std::vector<double> reduced_;          // [arc]
  std::vector<std::size_t> start_ = {0};
  std::vector<RowUse> uses_;
  std::vector<std::uint32_t> num_index_uses_;  // [arc]
};

struct SlackLimits {
  std::int64_t max_nodes = std::int64_t{1} << 60;
  double max_work = kInfinity;  ///< rows, and arcs times their rows, looked at; counted once a node
  /// Two packings whose slack is not the same differ by more than this: what is no better than one
  /// found by more is not looked for.  0 where costs lie on no grid.
  double step = 0;
  core::Deadline deadline;
  core::ForAll for_all;  ///< of the parts of a long search
};

/// When a search is shared out: it does first_work alone (SlackLimits::max_work), then several are
/// at it, each for round_work between two times that they share what is known and what is left.
struct SlackRounds {
  double first_work = 5e5;
  double round_work = 1e5;
};

struct SlackResult {
  double slack = kInfinity;         ///< of the best packing found below the budget; +inf = none
  std::vector<std::uint32_t> arcs;  ///< of that packing
  bool complete = false;            ///< none below the budget has less slack
  std::int64_t nodes = 0;
  double work = 0;  ///< as limited
  FixingYield fixing;
};

/// The packing of least slack, if that is below `budget` or exceeds it by rounding only: depth
/// first over the uses of rows, tightening prices on the way, and dividing what is left wherever it
/// falls apart.
///
/// Deterministic unless the deadline strikes, whatever `limits.for_all` does at once.  Cost:
/// exponential in the worst case; memory O(depth * arcs).
SlackResult search_slack(const SlackProblem& problem,
                         double budget,
                         const SlackLimits& limits,
                         const SlackRounds& rounds = {});

}  // namespace nda::bnb
