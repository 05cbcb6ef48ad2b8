#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::relax {

/// The cells of a component for m kept sets: runs of arcs that agree in their first m indices,
/// without (0 .. 0).  Arcs are in lexicographic order, so a cell is a range of arcs, cells are
/// sorted too, and the arcs of (0 .. 0), the free ones, come before all others.
struct Cells {
  int num_kept = 2;                    ///< m
  std::vector<core::ArcId> first_arc;  ///< of every cell, and num_arcs at the end
  std::vector<Index> row;              ///< i1; m = 2 only
  std::vector<Index> column;           ///< i2; m = 2 only

  /// Which way collapse() goes.  Cells of many arcs are taken one by one; where they fall into long
  /// runs of arcs that agree in i3 too, these are listed.  Of short cells every arc from
  /// num_free() on has its mark.
  std::vector<std::uint8_t> begins_cell;   ///< [arc - num_free()]: 1 for the first of its cell
  std::vector<std::uint32_t> first_run;    ///< of every cell, and the number of runs at the end
  std::vector<core::ArcId> first_run_arc;  ///< of every run, and num_arcs at the end
  std::vector<Index> run_index;            ///< i3 of every run

  std::size_t num_cells() const { return first_arc.size() - 1; }
  /// Whether cells have a few arcs on average.
  bool are_short() const { return !begins_cell.empty(); }
  /// Number of arcs of cell (0 .. 0): arcs 0..num_free() - 1.
  core::ArcId num_free() const { return first_arc.front(); }
};

/// @param num_kept  m, from 0 to the number of dimensions.
Cells find_cells(const core::Component& component, int num_kept = 2);

/// The collapse to m dimensions, eq. (3.3) with the sign of u turned: for every cell
///
///     d[cell] = min over its arcs of  c'[a] - sum over k >= m of u[slot(k, a)].
///
/// from[cell] is an arc of the cell that has the first that attains d[cell] after it, or is that;
/// it is not written where cells are short, and may be empty then.  u has num_slots() entries
/// (those of kept dimensions are ignored), the dummies' are 0.  Cost: O(A N); no allocation.
/// docs/benchmarks/roofline.md compares it with what the machine can do for m = 2.
void collapse(const core::Component& component,
              const Cells& cells,
              std::span<const double> u,
              std::span<double> d,
              std::span<core::ArcId> from);

/// The arcs of wanted cells, one after the other: of each the first arc that attains d[cell], after
/// a collapse with the same u.  Keeps references to everything.  Cost of an arc: O(N) per arc
/// between from[cell] and it, some dozens as a rule; the memory is asked for ahead.
class CheapestArcs {
 public:
  CheapestArcs(const core::Component& component,
               const Cells& cells,
               std::span<const double> u,
               std::span<const double> d,
               std::span<const core::ArcId> from,
               std::span<const std::uint32_t> wanted)
      : component_(component),
        cells_(cells),
        u_(u),
        d_(d),
        from_(cells.are_short() ? std::span(cells.first_arc) : from),
        wanted_(wanted) {}

  bool done() const { return at_ == wanted_.size(); }
  /// That of the next wanted cell.
  core::ArcId next();

 private:
  core::ArcId find(std::uint32_t cell) const;
  void prefetch_cell(std::uint32_t cell) const;
  void prefetch_arcs(std::uint32_t cell) const;

  const core::Component& component_;
  const Cells& cells_;
  std::span<const double> u_;
  std::span<const double> d_;
  std::span<const core::ArcId> from_;
  std::span<const std::uint32_t> wanted_;
  std::size_t at_ = 0;
};

}  // namespace nda::relax
