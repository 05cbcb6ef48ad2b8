#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/quad_heap.hpp"
#include "assign2d/side.hpp"

namespace nda::lap {

/// Assigns one side of a sparse problem by bids and shortest augmenting paths.
class SparsePaths {
 public:
  /// Prepares for sides of at most n members.
  void resize(std::size_t n);

  /// Serves every member of `own` that is in want: assigns it or lifts its dual to its outside
  /// cost.
  ///
  /// Needs and keeps: duals feasible, chosen pairs tight (to rounding).  Members of `other` that
  /// are assigned stay so unless a fallback to its outside option frees one at the end of the same
  /// path; their duals only decrease.  View = RowView or ColumnView.
  ///
  /// @return false if members of `own` cannot all be assigned: `hall` then names a set of them.
  /// Cost: one search per member that the bids left, each O(A log n) at worst, a few pairs in
  /// practice.
  template <class View>
  bool serve(const Phase<View>& phase, std::vector<std::uint32_t>& hall);

 private:
  // Where the shortest path found so far ends.
  struct End {
    double distance;
    bool outside;  // at the outside option of `member` of own; else at the free `member` of other
    std::uint32_t member;
  };

  template <class View>
  void bid_all(const Phase<View>& phase);
  template <class View>
  End search(const Phase<View>& phase, std::uint32_t source);
  template <class View>
  void scan(const Phase<View>& phase, std::uint32_t i, double distance, End& end);
  template <class View>
  void update_duals(const Phase<View>& phase, std::uint32_t source, double length) const;
  template <class View>
  void flip(const Phase<View>& phase, std::uint32_t source, const End& end) const;
  void forget_search();

  std::vector<std::uint32_t> waiting_;    // members of own in want
  std::vector<std::uint32_t> unserved_;   // those the bids left
  std::vector<double> distance_;          // of each member of other; +inf = not reached
  std::vector<std::uint32_t> from_;       // member of own before it on the path
  std::vector<std::uint32_t> from_pair_;  // pair between them, as the view counts
  std::vector<std::uint32_t> reached_;    // members of other with a distance
  std::vector<std::uint32_t> settled_;    // members of other whose distance is final
  QuadHeap heap_;
};

}  // namespace nda::lap
