#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/quad_heap.hpp"
#include "assign2d/side.hpp"
#include "assign2d/stop_check.hpp"

namespace nda::lap {

/// Assigns one side of a sparse problem by bids and shortest augmenting paths.
///
/// Both calls serve members of `own` that are in want: assign them or lift their duals to their
/// outside costs.  They need and keep: duals feasible, chosen pairs tight (to rounding).  Members
/// of `other` that are assigned stay so, unless a fallback of own to its outside option frees one;
/// their duals only decrease. View = RowView or ColumnView.
class SparsePaths {
 public:
  /// Prepares for sides of at most n members.
  void resize(std::size_t n);

  /// See Assign2dSolver::set_stop().
  void set_stop(const std::function<bool()>* stop) { stop_check_.set(stop); }

  /// Bids: cheap, may leave some in want.  @return how many.
  template <class View>
  std::size_t bid(const Phase<View>& phase);

  /// One search for each member in want, O(A log n) at worst, a few pairs in practice.
  /// @return false if members of `own` cannot all be assigned: `hall` then names a set of them.
  template <class View>
  bool search(const Phase<View>& phase, std::vector<std::uint32_t>& hall);

 private:
  // Where the shortest path found so far ends.
  struct End {
    double distance;
    bool outside;  // at the outside option of `member` of own; else at the free `member` of other
    std::uint32_t member;
  };

  template <class View>
  void list_wanting(const Phase<View>& phase);
  template <class View>
  End find_path(const Phase<View>& phase, std::uint32_t source);
  template <class View>
  void scan(const Phase<View>& phase, std::uint32_t i, double distance, End& end);
  template <class View>
  void update_duals(const Phase<View>& phase, std::uint32_t source, double length) const;
  template <class View>
  void flip(const Phase<View>& phase, std::uint32_t source, const End& end) const;
  void forget_search();

  StopCheck stop_check_;
  std::vector<std::uint32_t> waiting_;    // members of own in want
  std::vector<double> distance_;          // of each member of other; +inf = not reached
  std::vector<std::uint32_t> from_;       // member of own before it on the path
  std::vector<std::uint32_t> from_pair_;  // pair between them, as the view counts
  std::vector<std::uint32_t> reached_;    // members of other with a distance
  std::vector<std::uint32_t> settled_;    // members of other whose distance is final
  std::vector<std::uint32_t> ready_;      // members of other at the distance of the last settled
  QuadHeap heap_;                         // members of other further away
};

}  // namespace nda::lap
