#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "core/clock.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

struct RankLimits {
  std::int64_t max_nodes = 0;
  core::Deadline deadline;
};

/// Ranker::unlisted() makes so many whatever the clock says, if it has time to begin.
inline constexpr std::size_t kFewNeighbours = 10;

/// The solutions of a problem, best first, as many as are asked for.  It goes on where it stopped,
/// also where a limit struck.
class Ranker {
 public:
  virtual ~Ranker() = default;

  /// Lists solutions until there are `enough`, or all.  Returns whether the limits let it.
  /// @param planned  >= enough: how many will be asked for before long.  To list so many at once
  ///                 takes little more.
  virtual bool list(std::size_t enough, std::size_t planned, const RankLimits& limits) = 0;

  /// Each is proven: no other choice of so many is better.  All different; costs ascend but for
  /// rounding.  The first is that of the solution.
  const std::vector<RankedSolution>& listed() const { return listed_; }
  /// The same, when it has no more to do: nothing is listed after that.
  std::vector<RankedSolution> take() { return std::move(listed_); }
  /// There are no others.
  bool has_all() const { return has_all_; }
  /// Searched since the beginning.
  std::int64_t nodes() const { return nodes_; }

  /// Solutions near the best one that are not listed, the best `count` at hand but for the first
  /// `skipped`: none where the deadline leaves no time to look for them.
  virtual std::vector<RankedSolution> unlisted(std::size_t skipped,
                                               std::size_t count,
                                               const core::Deadline& deadline) = 0;

 protected:
  std::vector<RankedSolution> listed_;
  bool has_all_ = false;
  std::int64_t nodes_ = 0;
};

/// The one for the problem: with bounds on uses or without.
/// @param solution  has multipliers and a first entry, the best there is.  Where that is not
///                  proven only one may be listed.  Both must outlive it.
std::unique_ptr<Ranker> make_ranker(const Problem& problem, const Solution& solution);

}  // namespace nda::kbest
