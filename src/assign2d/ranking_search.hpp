#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/quad_heap.hpp"
#include "assign2d/ranking_core.hpp"
#include "assign2d/ranking_state.hpp"
#include "assign2d/ranking_subproblem.hpp"

namespace nda::lap {

/// Turns the best assignment of a set into the best one of a subset, by one shortest path.
class RankingSearch {
 public:
  struct Outcome {
    bool found = false;
    double loss = 0;      ///< what the assignment costs more; if not found, at least so much
    ChangeRange changes;  ///< in the log of the state; if not found, the state is as it was
  };

  void resize(std::uint32_t num_rows, std::uint32_t num_columns);

  /// The best assignment in which `row`, whose choices so far `subproblem` forbids, makes another
  /// one, if it costs at most `limit` more than that of the state, which must be the best without
  /// that.  O(pairs of the core * log) at worst, a few pairs in practice.
  Outcome choose_again(RankingState& state,
                       const RankingCore& core,
                       const RankingSubproblem& subproblem,
                       std::uint32_t row,
                       double limit);

 private:
  // Where the shortest path found so far ends.
  struct End {
    double distance;
    bool outside;  // at the outside option of `member` of own; else at the free `member` of other
    std::uint32_t member;
  };

  template <class Half>
  End find_path(const Half& half, std::uint32_t source, double limit);
  template <class Half>
  void scan(const Half& half, std::uint32_t member, double distance, End& end);
  void forget_search();
  void serve_row(RankingState& state,
                 const PairLines& pairs,
                 std::uint32_t source,
                 const End& end) const;
  void serve_column(RankingState& state,
                    const PairLines& pairs,
                    std::uint32_t source,
                    const End& end) const;

  double limit_ = 0;
  double least_beyond_ = 0;               // distance of what was passed over for the limit
  std::vector<double> distance_;          // of each member of other; +inf = not reached
  std::vector<std::uint32_t> from_;       // member of own before it on the path
  std::vector<std::uint32_t> from_pair_;  // pair between them, as the lines of own count
  std::vector<std::uint32_t> reached_;    // members of other with a distance
  std::vector<std::uint32_t> settled_;    // members of other whose distance is final
  QuadHeap heap_;                         // members of other with a distance that is not
};

}  // namespace nda::lap
