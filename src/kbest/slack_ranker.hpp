#pragma once

#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "kbest/combinations.hpp"
#include "kbest/part.hpp"
#include "kbest/ranker.hpp"
#include "kbest/slack_view.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// The solutions of a problem whose indices are used once, by a threshold on slack.
class SlackRanker : public Ranker {
 public:
  SlackRanker(const Problem& problem, const Solution& solution);

  bool list(std::size_t enough, std::size_t planned, const RankLimits& limits) override;
  std::vector<RankedSolution> unlisted(std::size_t skipped,
                                       std::size_t count,
                                       const core::Deadline& deadline) override;

 private:
  std::size_t num_neighbours() const { return neighbours_.size() + others_.size(); }
  bool look(std::size_t planned, const core::Deadline& deadline);
  void sort_neighbours(std::size_t count, const core::Deadline& deadline);
  double reach_of(std::size_t within, const core::Deadline& deadline);
  double next_reach(std::size_t planned, const core::Deadline& deadline);
  double reached() const;
  bool widen(double reach, std::size_t k, const RankLimits& limits);
  bool split(double reach, std::size_t k, const core::Deadline& deadline);
  bool replace_parts(const std::vector<core::ArcId>& near, const core::Deadline& deadline);
  bool add_sums(double reach, std::size_t k, const core::Deadline& deadline);
  bool is_listed(const std::vector<core::ArcId>& arcs, std::size_t hash) const;
  std::vector<core::ArcId> arcs_of(Combination combination) const;
  void append(Combination combination);

  const Problem& problem_;
  const Solution& solution_;
  std::optional<SlackView> view_;
  std::vector<SlackView::Neighbour> neighbours_;  // the cheapest, in order
  std::vector<SlackView::Neighbour> others_;      // a heap, the cheapest on top
  double error_ = 0;                              // of rounding
  double grid_ = 0;                               // spacing of the costs
  double cut_reach_ = -1;                         // what the parts were made for
  double next_arc_ = 0;                           // reduced cost that arcs in no part have at least
  std::vector<Part> parts_;                       // all arcs within cut_reach_
  double reach_ = 0;                              // all within are listed, unless that was
  bool is_cut_short_ = false;                     // by the number asked for
  std::size_t within_ = 0;                        // neighbours that the reach was for
  Combinations combinations_;
  std::unordered_multimap<std::size_t, Combination> by_hash_;  // arcs of those listed
};

}  // namespace nda::kbest
