#pragma once

#include <cstdint>
#include <vector>

#include "assign2d/side.hpp"
#include "assign2d/stop_check.hpp"

namespace nda::lap {

/// One phase of an algorithm on a full matrix: `own` looks for partners among `other`.
struct DensePhase {
  DenseView view;
  Side own;
  Side other;
};

/// What SparsePaths does, on a full matrix: the same contract, no heap, whole lines at a time.
class DensePaths {
 public:
  /// Prepares for sides of at most n members.
  void resize(std::size_t n);

  /// See Assign2dSolver::set_stop().
  void set_stop(const std::function<bool()>* stop) { stop_check_.set(stop); }

  /// Bids: cheap, may leave some in want.  @return true if nobody is.
  bool bid(const DensePhase& phase);

  /// One search for each member in want, O(rows * columns) at worst.
  /// @return false if members of `own` cannot all be assigned: `hall` then names a set of them.
  bool search(const DensePhase& phase, std::vector<std::uint32_t>& hall);

 private:
  // Where the shortest path found so far ends.
  struct End {
    double distance;
    bool outside;  // at the outside option of `member` of own; else at the free `member` of other
    std::uint32_t member;
  };

  void list_wanting(const DensePhase& phase);
  End find_path(const DensePhase& phase, std::uint32_t source);
  double scan(const DensePhase& phase, std::uint32_t i, double distance, End& end);
  void settle_nearest(const DensePhase& phase, double distance, End& end);
  void update_duals(const DensePhase& phase, std::uint32_t source, double length) const;
  void flip(const DensePhase& phase, std::uint32_t source, const End& end) const;

  StopCheck stop_check_;
  std::vector<std::uint32_t> waiting_;  // members of own in want
  std::vector<std::uint32_t> settled_;  // members of other in the order of their distances
  std::vector<double> settled_at_;      // those distances
  std::vector<double> price_;           // dual of other; -inf once settled
  std::vector<double> distance_;        // of members of other not settled
  std::vector<double> from_;            // member of own before it on the path
  std::vector<double> block_least_;
};

}  // namespace nda::lap
