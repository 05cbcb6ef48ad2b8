#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bounded/bounded_component.hpp"
#include "kbest/arc_sets.hpp"
#include "kbest/bounded_neighbours.hpp"
#include "kbest/combinations.hpp"
#include "kbest/ranker.hpp"

namespace nda::kbest {

/// The solutions of a problem with bounds on uses: those of each part are listed by the search that
/// finds the best one (bounded::list_best), and the least sums of one of each are the answer.  Long
/// lists are made in passes, and every pass searches anew, as does a call that lists more.
class BoundedRanker : public Ranker {
 public:
  BoundedRanker(const Problem& problem, const Solution& solution);

  bool list(std::size_t enough, std::size_t planned, const RankLimits& limits) override;
  std::vector<RankedSolution> unlisted(std::size_t skipped,
                                       std::size_t count,
                                       const core::Deadline& deadline) override;

 private:
  // The wanted of a part, by what they cost more than the best solution's.
  struct PartList {
    RankedList list;
    double reached = 0;        // none that is not in the list costs less than this more
    bool is_complete = false;  // no limit stopped it
  };

  bool look(const core::Deadline& deadline);
  bool pass(std::size_t k, const RankLimits& limits);
  std::vector<core::ArcId> arcs_within(double reach) const;
  PartList rank(bounded::BoundedComponent part,
                std::span<const std::size_t> neighbours,
                double reach,
                std::size_t k,
                const RankLimits& limits,
                Combinations& combinations);
  bool add_sums(const std::vector<PartList>& parts,
                std::size_t k,
                const core::Deadline& deadline,
                Combinations& combinations);
  RankedSolution solution_of(std::span<const core::ArcId> arcs) const;

  const Problem& problem_;
  const Solution& solution_;
  bounded::BoundedComponent whole_;  // all arcs that may be used
  std::vector<core::ArcId> best_;    // of its arcs
  double margin_ = 0;                // solutions whose costs differ at all differ by more
  double error_ = 0;                 // of rounding
  std::vector<BoundedNeighbour> neighbours_;
  ArcSets known_;                                // arcs of those listed
  std::vector<std::vector<core::ArcId>> spare_;  // of those found and not proven
  bool has_looked_ = false;
};

}  // namespace nda::kbest
