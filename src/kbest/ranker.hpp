#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/clock.hpp"
#include "kbest/combinations.hpp"
#include "kbest/part.hpp"
#include "kbest/slack_view.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

struct RankLimits {
  std::int64_t max_nodes = 0;
  core::Deadline deadline;
};

/// The solutions of a problem, best first, as many as are asked for.  It goes on where it stopped,
/// also where a limit struck: what was found is not searched again.
class Ranker {
 public:
  /// @param solution  has multipliers and a first entry, the best there is.  Where that is not
  ///                  proven only one may be listed.  Both must outlive it.
  Ranker(const Problem& problem, const Solution& solution);

  /// Lists solutions until there are `enough`, or all.  Returns whether the limits let it.
  /// @param planned  >= enough: how many will be asked for before long.  To list so many at once
  ///                 takes little more.
  bool list(std::size_t enough, std::size_t planned, const RankLimits& limits);

  /// Each is proven: no other choice of so many is better.  All different; costs ascend but for
  /// rounding.  The first is that of the solution.
  const std::vector<RankedSolution>& listed() const { return listed_; }
  /// There are no others.
  bool has_all() const { return has_all_; }
  /// Searched since the beginning.
  std::int64_t nodes() const { return nodes_; }

  /// The neighbours of the best solution (SlackView) that are not listed, the best `count` but for
  /// the first `skipped`: none where the deadline leaves no time to look for them.
  std::vector<RankedSolution> unlisted(std::size_t skipped,
                                       std::size_t count,
                                       const core::Deadline& deadline);

 private:
  bool look(std::size_t planned, const core::Deadline& deadline);
  void sort_neighbours(std::size_t count);
  double reach_of(std::size_t within);
  double next_reach(std::size_t planned);
  double reached() const;
  bool widen(double reach, std::size_t k, const RankLimits& limits);
  bool split(double reach, std::size_t k, const core::Deadline& deadline);
  bool replace_parts(const std::vector<core::ArcId>& near, const core::Deadline& deadline);
  bool add_sums(double reach, std::size_t k, const core::Deadline& deadline);
  bool is_listed(const std::vector<core::ArcId>& arcs) const;
  void append(std::vector<std::vector<core::ArcId>> found);

  const Problem& problem_;
  const Solution& solution_;
  std::optional<SlackView> view_;
  std::vector<SlackView::Neighbour> neighbours_;
  std::size_t num_sorted_ = 0;  // of them, the cheapest
  double error_ = 0;            // of rounding
  double grid_ = 0;             // spacing of the costs
  double cut_reach_ = -1;       // what the parts were made for
  double next_arc_ = 0;         // reduced cost that arcs in no part have at least
  std::vector<Part> parts_;     // all arcs within cut_reach_
  double reach_ = 0;            // all within are listed, unless that was
  bool is_cut_short_ = false;   // by the number asked for
  std::size_t within_ = 0;      // neighbours that the reach was for
  Combinations combinations_;
  std::vector<RankedSolution> listed_;
  std::vector<std::vector<core::ArcId>> arcs_;  // of those listed, in the order they were found
  std::unordered_multimap<std::size_t, std::size_t> by_hash_;  // of the arcs, their number
  bool has_all_ = false;
  std::int64_t nodes_ = 0;
};

}  // namespace nda::kbest
