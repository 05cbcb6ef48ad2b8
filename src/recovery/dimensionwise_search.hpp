#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "assign2d/shortest_path.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/random.hpp"

namespace nda::recovery {

/// The dimensionwise move, on components that have a good part of all tuples there could be.
///
/// A *cut* divides the dimensions into two sets and with them every arc of the packing into two
/// parts, its indices in one set and those in the other; an uncovered index is a part of its own.
/// Which part of one set goes with which of the other, over the arcs there are, or stays alone, is
/// a two-dimensional assignment.  The packing is one of its solutions, so the best is no dearer.
/// There are 2^(N - 1) - 1 cuts; those that set one dimension apart re-optimise its indices.
class DimensionwiseSearch {
 public:
  /// Whether a table of all tuples, dummies included, is small beside the arcs, at most
  /// kMostTuplesPerArc for each, and there are 3..kMostDimensions dimensions.  With fewer arcs the
  /// parts of a packing hardly ever fit together otherwise.
  static constexpr double kMostTuplesPerArc = 8;
  static constexpr int kMostDimensions = 8;
  static bool suits(const core::Component& component);

  /// Of a component that suits; keeps a reference.  Does nothing from the deadline on, then and
  /// later. Memory: 4 bytes a tuple.  Cost: O(A N).
  DimensionwiseSearch(const core::Component& component, const core::Deadline& deadline);
  DimensionwiseSearch(const DimensionwiseSearch&) = delete;
  DimensionwiseSearch& operator=(const DimensionwiseSearch&) = delete;

  /// Covers what it can by tuples of uncovered indices, then makes the moves of all cuts until none
  /// improves, in place.  Never makes the packing dearer.  Returns the work it took (some 3e8 a
  /// second): a table look-up and a step of the assignment for every pair of parts.
  double descend(core::Packing& packing);

  /// Descends, then again and again from the best packing with a few arcs shuffled (iterated local
  /// search), in place; ends at cost <= goal, or when that took so much work, which it returns.
  /// Deterministic for a given state of `random`.
  double improve(core::Packing& packing, double max_work, double goal, core::Random& random);

 private:
  using Arcs = std::vector<core::ArcId>;

  void fill_table();
  double cost_of(std::uint64_t key) const;
  double cost_of(const Arcs& arcs) const;
  void mark_covered(const Arcs& arcs);
  void fill(Arcs& arcs);
  void descend(Arcs& arcs);
  bool reassign(std::uint32_t cut, Arcs& arcs);
  void list_parts(std::uint32_t cut, const Arcs& arcs);
  void list_costs();
  void join(Arcs& arcs) const;
  void add(std::uint64_t key, Arcs& arcs) const;
  void shuffle(Arcs& arcs, core::Random& random) const;

  const core::Component& component_;
  const core::Deadline deadline_;
  const std::function<bool()> stop_;
  std::vector<std::uint64_t> stride_;  // [slot]: its share of the key of a tuple
  Arcs table_;                         // [key]: the arc, if it saves anything
  double work_ = 0;
  // Of a move.
  std::vector<char> is_covered_;     // [slot]
  std::vector<std::uint64_t> rows_;  // keys of the parts
  std::vector<std::uint64_t> columns_;
  std::vector<double> cost_;  // row by row
  std::vector<double> row_outside_;
  std::vector<double> column_outside_;
  lap::ShortestPathSolver solver_;
  Assign2dResult assignment_;
};

}  // namespace nda::recovery
