#include "bounded/recovery_problem.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "bounded/parts.hpp"

namespace nda::bounded {
namespace {

using core::ArcId;

// An aligned cell, and how often the relaxed solution uses it.
struct Aligned {
  std::size_t cell;
  Index uses;
  double least;  // reduced cost of the cheapest arc chosen
};

class Builder {
 public:
  Builder(const BoundedComponent& component,
          const Cells& cells,
          std::span<const ArcId> chosen,
          std::span<const double> reduced)
      : component_(component), cells_(cells) {
    align(chosen, reduced);
  }

  BoundedComponent build() {
    make_rows();
    if (cells_.num_free > 0) add_arcs(0, 0);
    for (std::size_t j = 1; j <= aligned_.size(); ++j) {
      ask(j);
      add_arcs(aligned_[j - 1].cell, static_cast<Index>(j));
    }
    fit_rows(result_);
    return std::move(result_);
  }

 private:
  void align(std::span<const ArcId> chosen, std::span<const double> reduced) {
    std::vector<char> is_chosen(component_.num_arcs(), 0);
    for (const ArcId a : chosen) is_chosen[a] = 1;
    uses_ = count_uses(component_.graph, chosen);
    for (std::size_t cell = cells_.num_free; cell < cells_.num_cells(); ++cell) {
      Aligned aligned{cell, 0, kInfinity};
      for (const ArcId a : cells_[cell]) {
        if (is_chosen[a] == 0) continue;
        ++aligned.uses;
        aligned.least = std::min(aligned.least, reduced[a]);
      }
      if (aligned.uses > 0) aligned_.push_back(aligned);
    }
    // The cheapest first: theirs are the uses that must be.
    std::stable_sort(aligned_.begin(), aligned_.end(), [](const Aligned& a, const Aligned& b) {
      return a.least < b.least;
    });
  }

  void make_rows() {
    const core::Component& graph = component_.graph;
    std::vector<Index> sizes = {static_cast<Index>(aligned_.size())};
    sizes.insert(sizes.end(), graph.sizes.begin() + cells_.num_kept, graph.sizes.end());
    result_.graph = core::make_component(std::move(sizes));
    result_.rows.resize(result_.graph.num_slots());
    for (std::size_t j = 1; j <= aligned_.size(); ++j) result_.rows[j].hi = aligned_[j - 1].uses;
    const auto kept = static_cast<std::size_t>(cells_.num_kept);
    for (std::size_t k = 1; k < result_.graph.sizes.size(); ++k) {
      const std::uint32_t from = graph.offset[k + kept - 1];
      const std::uint32_t to = result_.graph.offset[k];
      for (Index i = 1; i <= result_.graph.sizes[k]; ++i)
        result_.rows[to + i] = component_.rows[from + i];
    }
    lacking_.reserve(uses_.size());
    for (const Row& row : component_.rows) lacking_.push_back(row.lo);
  }

  // What row j pays for uses that it lacks.
  void ask(std::size_t j) {
    Row& row = result_.rows[j];
    const ArcId any = cells_[aligned_[j - 1].cell].front();
    charge_ = 0;
    for (int k = 0; k < cells_.num_kept; ++k) {
      const std::uint32_t slot = component_.graph.slot(k, any);
      const Index must = std::min(lacking_[slot], row.hi);
      lacking_[slot] -= must;
      if (must == row.hi) {
        charge_ += component_.rows[slot].single;
      } else if (must > 0) {
        row.lo = std::max(row.lo, must);
        row.single += component_.rows[slot].single;
      }
    }
  }

  void add_arcs(std::size_t cell, Index j) {
    const core::Component& graph = component_.graph;
    std::vector<Index> tuple(result_.graph.sizes.size());
    tuple[0] = j;
    for (const ArcId a : cells_[cell]) {
      for (std::size_t k = 1; k < tuple.size(); ++k)
        tuple[k] = graph.index(static_cast<int>(k) + cells_.num_kept - 1, a);
      core::append_arc(result_.graph, tuple, graph.costs[a] - (j == 0 ? 0.0 : charge_));
      result_.graph.arc_origin.push_back(a);
    }
  }

  const BoundedComponent& component_;
  const Cells& cells_;
  std::vector<Aligned> aligned_;
  std::vector<Index> uses_;     // [slot] by the alignment
  std::vector<Index> lacking_;  // [slot] uses that must be, not yet given to a cell
  double charge_ = 0;           // of row j for every use
  BoundedComponent result_;
};

}  // namespace

BoundedComponent make_recovery_problem(const BoundedComponent& component,
                                       const Cells& cells,
                                       std::span<const ArcId> chosen,
                                       std::span<const double> reduced) {
  return Builder(component, cells, chosen, reduced).build();
}

}  // namespace nda::bounded
