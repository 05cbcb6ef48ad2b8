#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "nda/types.hpp"

namespace nda::bnb {

/// Arcs and what they gain, and the rows they use: no two arcs that share a row go together.
class CliqueProblem {
 public:
  /// @param gain  finite; > 0 where only the best packing counts.
  /// @param rows  numbered from 0, each once.
  void add_arc(double gain, std::span<const std::uint32_t> rows);

  std::uint32_t num_arcs() const { return static_cast<std::uint32_t>(gain_.size()); }
  std::uint32_t num_rows() const { return num_rows_; }
  double gain(std::uint32_t arc) const { return gain_[arc]; }
  std::span<const std::uint32_t> rows(std::uint32_t arc) const {
    return std::span(rows_).subspan(start_[arc], start_[arc + 1] - start_[arc]);
  }

 private:
  std::uint32_t num_rows_ = 0;
  std::vector<double> gain_;  // [arc]
  std::vector<std::size_t> start_ = {0};
  std::vector<std::uint32_t> rows_;
};

/// Problems with more arcs are not searched.
inline constexpr std::uint32_t kMostCliqueArcs = 1024;

struct CliqueLimits {
  std::int64_t max_nodes = std::int64_t{1} << 60;
  /// Of the size of SlackLimits::max_work.  A search that has hardly begun after an eighth of it is
  /// given up then, one that is well advanced may take sixteen times as long.
  double max_work = kInfinity;
  core::Deadline deadline;
};

struct CliqueResult {
  std::vector<std::uint32_t> arcs;  ///< of the best packing found that gains more than the target
  /// If complete: no packing gains more than this, which is the gain of the best packing, or the
  /// target if there is none, but for rounding.
  double most = kInfinity;
  bool complete = false;
  std::int64_t nodes = 0;
  double work = 0;  ///< as limited
};

/// The packing of greatest gain, if it gains more than `target`: depth first over the arcs that a
/// cover of the others by cliques leaves over.
///
/// Gains are counted in whole units of less than 2^-60 of their sum, rounded up.  Deterministic
/// unless the deadline strikes.  Not complete, with no node, beyond kMostCliqueArcs, and where a
/// proof may not go deeper.  Cost: exponential in the worst case; memory O(arcs^2) bits.
CliqueResult search_cliques(const CliqueProblem& problem,
                            double target,
                            const CliqueLimits& limits);

struct CliquePacking {
  double gain = 0;
  std::vector<std::uint32_t> arcs;  ///< ascending
};

struct CliqueRanking {
  std::vector<CliquePacking> packings;  ///< greatest gain first, all different
  bool complete = false;  ///< these are the k best that gain more than the target, or all of them
  std::int64_t nodes = 0;
  double work = 0;  ///< as limited
};

/// The k packings of greatest gain among those that gain more than `target`, the empty one counted
/// with them, by the same search: it looks for what gains more than the k-th found so far.
///
/// @param k     >= 1.
/// @param unit  what gains are multiples of but for rounding, which is then taken away; 0 = none.
///              Their sum is less than 2^60 units.
CliqueRanking rank_cliques(const CliqueProblem& problem,
                           std::size_t k,
                           double target,
                           double unit,
                           const CliqueLimits& limits);

}  // namespace nda::bnb
