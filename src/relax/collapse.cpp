#include "relax/collapse.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

#include "core/loads.hpp"
#include "core/min_max.hpp"
#include "core/reduced_costs.hpp"

// Most of the relaxation's time goes into this loop (report, section 5: "the dominant computational
// part is the evaluation of the relaxed two-dimensional cost coefficients").  Four things keep a
// processor from loading as fast as it could:
//   - Which arc attains the minimum.  Every new minimum is a jump that was not foreseen, or a chain
//     of moves; the assignment takes few of the cells.  So only the minimum is computed, and where
//     some arcs that hold it begin; CheapestArcs looks through these where the arc is wanted.  The
//     report breaks ties by the lexicographically smallest tuple, which is the first arc.
//   - The end of a cell is not foreseen either.  Cells of a few arcs are therefore not taken one by
//     one: all arcs pass by, the minimum is forgotten where a cell begins, and is written after
//     every arc.  Every minimum waits for the one before it, so arcs pass in two rows at a time,
//     near enough to each other for what is read and written to be one stream in memory.
//   - Loads: arcs of a cell that agree in their third index share its multiplier, and the indices
//     of two arcs are loaded at once.
//   - Waiting for memory: arcs of long cells are asked for some hundred ahead, and those that are
//     looked through some cells ahead.
// Reduced costs come out in the same bits whatever the way, as the order of subtractions is always
// that of the dimensions.

namespace nda::relax {
namespace {

using core::ArcId;
using core::Component;
using core::max_of;
using core::min_of;

// Cells of fewer arcs on average are not taken one by one, and runs of fewer not as such, nor runs
// of medium length where there are more of them than a processor learns the ends of; measured.
constexpr std::size_t kLongCell = 16;
constexpr std::size_t kMediumRun = 12;
constexpr std::size_t kLongRun = 32;
constexpr std::size_t kMostMediumRuns = 2000;
// Arcs that are looked through for one of them.
constexpr ArcId kBlock = 16;
// Cells whose arcs are asked for before they are looked through.
constexpr std::size_t kCellsAhead = 12;
// How far ahead arcs are asked for; measured.
constexpr std::size_t kAhead = 512;
// Arcs that pass by in two rows.
constexpr std::size_t kPassing = 64;

struct Relaxed {
  const Index* index;
  const double* u;
};
using RelaxedColumns = std::array<Relaxed, kMaxDimensions>;

RelaxedColumns relaxed_columns(const Component& component,
                               std::size_t num_kept,
                               std::span<const double> u) {
  RelaxedColumns columns;
  for (std::size_t k = num_kept; k < component.sizes.size(); ++k) {
    columns[k - num_kept] = {component.indices[k].data(), u.data() + component.offset[k]};
  }
  return columns;
}

void mark_beginnings(Cells& cells) {
  cells.begins_cell.assign(cells.first_arc.back() - cells.num_free(), 0);
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    cells.begins_cell[cells.first_arc[cell] - cells.num_free()] = 1;
  }
}

void find_runs(const core::Column& index, Cells& cells) {
  for (std::size_t cell = 0; cell < cells.num_cells(); ++cell) {
    cells.first_run.push_back(static_cast<std::uint32_t>(cells.run_index.size()));
    const ArcId first = cells.first_arc[cell];
    for (ArcId a = first; a < cells.first_arc[cell + 1]; ++a) {
      if (a > first && index[a] == index[a - 1]) continue;
      cells.first_run_arc.push_back(a);
      cells.run_index.push_back(index[a]);
    }
  }
  cells.first_run.push_back(static_cast<std::uint32_t>(cells.run_index.size()));
  cells.first_run_arc.push_back(cells.first_arc.back());
}

void forget_runs(Cells& cells) {
  cells.first_run = {};
  cells.first_run_arc = {};
  cells.run_index = {};
}

bool agree(const Component& component, int num_kept, ArcId a, ArcId b) {
  for (int k = 0; k < num_kept; ++k) {
    if (component.index(k, a) != component.index(k, b)) return false;
  }
  return true;
}

bool is_free(const Component& component, int num_kept, ArcId a) {
  for (int k = 0; k < num_kept; ++k) {
    if (component.index(k, a) != 0) return false;
  }
  return true;
}

// The ways of collapse() for a number of relaxed dimensions that is known at compile time, or
// kAny.
constexpr std::size_t kAny = 0;

template <std::size_t kRelaxed>
class Collapse {
 public:
  Collapse(const Component& component, const Cells& cells, std::span<const double> u)
      : cells_(cells),
        cost_(component.costs.data()),
        num_relaxed_(component.sizes.size() - static_cast<std::size_t>(cells.num_kept)),
        relaxed_(relaxed_columns(component, component.sizes.size() - num_relaxed_, u)) {}

  void by_cells(std::span<double> d, std::span<ArcId> from) const {
    for (std::size_t cell = 0; cell < d.size(); ++cell) {
      Least best{kInfinity, cells_.first_arc[cell]};
      const ArcId end = cells_.first_arc[cell + 1];
      ArcId a = cells_.first_arc[cell];
      for (; a + kBlock <= end; a += kBlock) {
        prefetch(a + kAhead);
        best.improve(least<false>(a, a + kBlock, 0.0), a);
      }
      if (a < end) best.improve(least<false>(a, end, 0.0), a);
      d[cell] = best.value;
      from[cell] = best.from;
    }
  }

  void by_arcs(std::span<double> d) const {
    const std::uint8_t* const begins = cells_.begins_cell.data();
    const std::size_t size = cells_.begins_cell.size();
    Row front{~std::size_t{0}, kInfinity};  // the first arc leads to cell 0
    for (std::size_t first = 0; first < size;) {
      const std::size_t end = first + std::min(kPassing, size - first);
      const std::uint8_t* const half = begins + (first + end + 1) / 2;
      const auto middle = static_cast<std::size_t>(std::find(half, begins + end, 1) - begins);
      Row back{std::accumulate(begins + first, begins + middle, front.cell), kInfinity};
      std::size_t n = first;
      std::size_t m = middle;
      for (; m + 1 < end; m += 2, n += 2) pass_twice(front, n, back, m, d);
      if (m < end) {
        pass(front, n, reduced<false>(arc(n), 0.0), d);
        pass(back, m, reduced<false>(arc(m), 0.0), d);
        ++n;
      }
      for (; n < middle; ++n) pass(front, n, reduced<false>(arc(n), 0.0), d);
      if (middle < end) front = back;
      first = end;
    }
  }

  void by_runs(std::span<double> d, std::span<ArcId> from) const {
    for (std::size_t cell = 0; cell < d.size(); ++cell) {
      Least best{kInfinity, cells_.first_arc[cell]};
      for (std::uint32_t run = cells_.first_run[cell]; run < cells_.first_run[cell + 1]; ++run) {
        const double shared = relaxed_[0].u[cells_.run_index[run]];
        const ArcId a = cells_.first_run_arc[run];
        best.improve(least<true>(a, cells_.first_run_arc[run + 1], shared), a);
      }
      d[cell] = best.value;
      from[cell] = best.from;
    }
  }

 private:
  // The least so far, and where the arcs begin that hold it; without a jump.
  struct Least {
    double value;
    ArcId from;

    void improve(double other, ArcId other_from) {
      from = other < value ? other_from : from;
      value = min_of(value, other);
    }
  };

  // Of a row of passing arcs: the cell of the last one, and the least of that cell so far.
  struct Row {
    std::size_t cell;
    double least;
  };

  // The n-th that is not free.
  ArcId arc(std::size_t n) const { return cells_.num_free() + static_cast<ArcId>(n); }

  // That arc, of reduced cost r, without a jump.
  void pass(Row& row, std::size_t n, double r, std::span<double> d) const {
    constexpr std::array kForget = {-kInfinity, kInfinity};
    const std::size_t begins = cells_.begins_cell[n];
    row.cell += begins;
    row.least = min_of(max_of(row.least, kForget[begins]), r);
    d[row.cell] = row.least;
  }

  // Two arcs of each row, from n and from m on.
  void pass_twice(Row& front, std::size_t n, Row& back, std::size_t m, std::span<double> d) const {
    const auto [first, second] = two_reduced<false>(arc(n), 0.0);
    const auto [third, fourth] = two_reduced<false>(arc(m), 0.0);
    pass(front, n, first, d);
    pass(back, m, third, d);
    pass(front, n + 1, second, d);
    pass(back, m + 1, fourth, d);
  }

  // The arcs a .. a + kBlock - 1, or thereabouts.
  void prefetch(std::size_t a) const {
    core::prefetch(cost_, a);
    core::prefetch(cost_, a + kBlock / 2);
    for (std::size_t k = 0; k < count(); ++k) core::prefetch(relaxed_[k].index, a);
  }

  // Over arcs a..end-1; `shared` is the multiplier of the first relaxed dimension if kShared.  Two
  // minima at a time do not wait for one another.
  template <bool kShared>
  double least(ArcId a, ArcId end, double shared) const {
    double even = kInfinity;
    double odd = kInfinity;
    for (; a + 1 < end; a += 2) {
      const auto [first, second] = two_reduced<kShared>(a, shared);
      even = min_of(even, first);
      odd = min_of(odd, second);
    }
    if (a < end) even = min_of(even, reduced<kShared>(a, shared));
    return min_of(even, odd);
  }

  template <bool kShared>
  double reduced(ArcId a, double shared) const {
    double r = cost_[a];
    if constexpr (kShared) r -= shared;
    for (std::size_t k = kShared ? 1 : 0; k < count(); ++k) {
      r -= relaxed_[k].u[relaxed_[k].index[a]];
    }
    return r;
  }

  // Of arcs a and a + 1.
  template <bool kShared>
  std::pair<double, double> two_reduced(ArcId a, double shared) const {
    std::pair<double, double> r(cost_[a], cost_[a + 1]);
    if constexpr (kShared) {
      r.first -= shared;
      r.second -= shared;
    }
    for (std::size_t k = kShared ? 1 : 0; k < count(); ++k) {
      const auto [i, j] = core::two_indices(relaxed_[k].index + a);
      r.first -= relaxed_[k].u[i];
      r.second -= relaxed_[k].u[j];
    }
    return r;
  }

  std::size_t count() const { return kRelaxed == kAny ? num_relaxed_ : kRelaxed; }

  const Cells& cells_;
  const double* const cost_;
  const std::size_t num_relaxed_;
  const RelaxedColumns relaxed_;
};

template <std::size_t kRelaxed>
void collapse_cells(const Component& component,
                    const Cells& cells,
                    std::span<const double> u,
                    std::span<double> d,
                    std::span<ArcId> from) {
  const Collapse<kRelaxed> ways(component, cells, u);
  if (cells.are_short()) {
    ways.by_arcs(d);
  } else if (cells.run_index.empty()) {
    ways.by_cells(d, from);
  } else {
    ways.by_runs(d, from);
  }
}

}  // namespace

Cells find_cells(const Component& component, int num_kept) {
  Cells cells;
  cells.num_kept = num_kept;
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    if (a > 0 && agree(component, num_kept, a, a - 1)) continue;
    if (is_free(component, num_kept, a)) continue;
    cells.first_arc.push_back(a);
    if (num_kept != 2) continue;
    cells.row.push_back(component.index(0, a));
    cells.column.push_back(component.index(1, a));
  }
  cells.first_arc.push_back(static_cast<ArcId>(component.num_arcs()));
  const std::size_t num_arcs = component.num_arcs() - cells.num_free();
  if (num_kept != 2 || num_arcs < kLongCell * cells.num_cells()) {
    mark_beginnings(cells);
  } else if (component.num_dimensions() > 3) {
    find_runs(component.indices[2], cells);
    const std::size_t num_runs = cells.run_index.size();
    const std::size_t least_length = num_runs > kMostMediumRuns ? kLongRun : kMediumRun;
    if (num_arcs < least_length * num_runs) forget_runs(cells);
  }
  return cells;
}

void collapse(const Component& component,
              const Cells& cells,
              std::span<const double> u,
              std::span<double> d,
              std::span<ArcId> from) {
  switch (component.num_dimensions() - cells.num_kept) {
    case 1:
      return collapse_cells<1>(component, cells, u, d, from);
    case 2:
      return collapse_cells<2>(component, cells, u, d, from);
    case 3:
      return collapse_cells<3>(component, cells, u, d, from);
    case 4:
      return collapse_cells<4>(component, cells, u, d, from);
    case 5:
      return collapse_cells<5>(component, cells, u, d, from);
    case 6:
      return collapse_cells<6>(component, cells, u, d, from);
    default:
      return collapse_cells<kAny>(component, cells, u, d, from);
  }
}

ArcId CheapestArcs::next() {
  if (at_ + 2 * kCellsAhead < wanted_.size()) prefetch_cell(wanted_[at_ + 2 * kCellsAhead]);
  if (at_ + kCellsAhead < wanted_.size()) prefetch_arcs(wanted_[at_ + kCellsAhead]);
  return find(wanted_[at_++]);
}

// The arcs of all blocks from `from` on are looked through.
ArcId CheapestArcs::find(std::uint32_t cell) const {
  const ArcId end = cells_.first_arc[cell + 1];
  if (from_[cell] + 1 == end) return from_[cell];
  std::array<double, kBlock> r;
  for (ArcId a = from_[cell]; a < end;) {
    const std::span<double> block = std::span(r).first(std::min(kBlock, end - a));
    core::reduced_costs(component_, u_, a, block, cells_.num_kept);
    const auto found = std::find(block.begin(), block.end(), d_[cell]);
    if (found != block.end()) return a + static_cast<ArcId>(found - block.begin());
    a += static_cast<ArcId>(block.size());
  }
  return from_[cell];
}

void CheapestArcs::prefetch_cell(std::uint32_t cell) const {
  core::prefetch(cells_.first_arc.data(), cell + 1);
  core::prefetch(from_.data(), cell);
  core::prefetch(d_.data(), cell);
}

// The first block that find() looks through.
void CheapestArcs::prefetch_arcs(std::uint32_t cell) const {
  const ArcId first = from_[cell];
  const ArcId last = std::min(first + kBlock, cells_.first_arc[cell + 1]) - 1;
  for (ArcId a = first; a < last; a += kBlock / 2) core::prefetch(component_.costs.data(), a);
  core::prefetch(component_.costs.data(), last);
  for (auto k = static_cast<std::size_t>(cells_.num_kept); k < component_.sizes.size(); ++k) {
    core::prefetch(component_.indices[k].data(), first);
    core::prefetch(component_.indices[k].data(), last);
  }
}

}  // namespace nda::relax
