#include "recovery/recovery_problem.hpp"

#include <algorithm>

#include "core/slices.hpp"
#include "decompose/components.hpp"
#include "recovery/packing_state.hpp"

// The relaxed solution covers the kept dimensions properly and the others not.  The report keeps
// what is right: every chosen cell (i1 .. im) becomes one row j of a problem of the relaxed
// dimensions, whose solution says how the cells go on.  Arcs of cell (0 .. 0) stay free whatever
// the relaxed solution chose (report, before (3.7)). Arcs that are not in the sparse set are simply
// absent; row j may always stay uncovered, which is the report's c(j 0..0) = sum of singletons, 0
// in shifted form. Only after it is formulated can a recovery problem be decomposed (4.7), and it
// nearly always falls apart: an alignment cuts most connections.

namespace nda::recovery {
namespace {

using core::ArcId;
using core::Component;
using core::Deadline;

// True when all indices of relaxed dimensions are dummies.
bool ends_here(const Component& component, int num_kept, ArcId a) {
  for (int k = num_kept; k < component.num_dimensions(); ++k) {
    if (component.index(k, a) != 0) return false;
  }
  return true;
}

class Builder {
 public:
  Builder(const Component& component, const Deadline& deadline)
      : component_(component), deadline_(deadline) {}

  RecoveryProblem build(const relax::Cells& cells, std::span<const std::uint32_t> aligned) {
    std::vector<std::uint32_t> rows(aligned.begin(), aligned.end());
    std::sort(rows.begin(), rows.end());
    std::vector<Index> sizes = {static_cast<Index>(rows.size())};
    result_.num_kept = cells.num_kept;
    sizes.insert(sizes.end(), component_.sizes.begin() + cells.num_kept, component_.sizes.end());
    Component& component = result_.component;
    component = core::make_component(std::move(sizes));
    result_.default_arc.assign(rows.size() + 1, kNoArc);
    if (cells.num_free() > 0) add_row(0, cells.num_free(), 0);
    core::for_each_until(deadline_, rows.size(), [&](std::size_t j) {
      const std::uint32_t cell = rows[j];
      add_row(cells.first_arc[cell], cells.first_arc[cell + 1], static_cast<Index>(j + 1));
    });
    const std::span<Index> row = component.indices[0].allocate(row_.size());
    std::copy(row_.begin(), row_.end(), row.begin());
    for (std::size_t k = 1; k < component.sizes.size(); ++k) copy_column(k);
    return std::move(result_);
  }

 private:
  // Of dimension k of the result.
  void copy_column(std::size_t k) {
    const std::vector<ArcId>& arcs = result_.component.arc_origin;
    const auto skipped = static_cast<std::size_t>(result_.num_kept) - 1;
    const Index* from = component_.indices[k + skipped].data();
    const std::span<Index> to = result_.component.indices[k].allocate(arcs.size());
    for (std::size_t n = 0; n < arcs.size(); ++n) to[n] = from[arcs[n]];
  }

  // Row j, of arcs first..end-1 of a cell.
  void add_row(ArcId first, ArcId end, Index j) {
    double base = 0;
    // (j, 0..0) is lexicographically the first arc of its cell.
    if (ends_here(component_, result_.num_kept, first)) {
      base = std::min(0.0, component_.costs[first]);
      if (base < 0) result_.default_arc[j] = first;
      ++first;
    }
    Component& component = result_.component;
    for (ArcId a = first; a < end; ++a) {
      if (component_.costs[a] - base >= 0) continue;
      row_.push_back(j);
      component.costs.push_back(component_.costs[a] - base);
      component.arc_origin.push_back(a);
    }
  }

  const Component& component_;
  const Deadline& deadline_;
  std::vector<Index> row_;  // of every arc of the result
  RecoveryProblem result_;
};

}  // namespace

RecoveryProblem make_recovery_problem(const Component& component,
                                      const relax::Cells& cells,
                                      std::span<const std::uint32_t> aligned,
                                      const Deadline& deadline) {
  return Builder(component, deadline).build(cells, aligned);
}

std::vector<Component> cut_parts(const RecoveryProblem& problem,
                                 const Deadline& deadline,
                                 bool decompose) {
  std::vector<Component> parts;
  core::Cutter cutter;
  decompose::Partition partition = decompose::partition(problem.component, deadline);
  if (!decompose) decompose::join(partition);
  for (std::size_t c = 0; c < partition.num_components() && !deadline.reached(); ++c) {
    const std::span<const ArcId> arcs = partition.component(c);
    Component& part = parts.emplace_back(cutter.cut(problem.component, arcs));
    part.arc_origin.assign(arcs.begin(), arcs.end());
  }
  return parts;
}

core::Packing recovered_packing(const Component& component,
                                const RecoveryProblem& problem,
                                std::span<const ArcId> arcs) {
  std::vector<bool> covered(problem.default_arc.size(), false);
  std::vector<ArcId> recovered;
  for (const ArcId a : arcs) {
    covered[problem.component.index(0, a)] = true;
    recovered.push_back(problem.component.arc_origin[a]);
  }
  for (std::size_t j = 1; j < covered.size(); ++j) {
    if (!covered[j] && problem.default_arc[j] != kNoArc)
      recovered.push_back(problem.default_arc[j]);
  }
  return core::make_packing(component, std::move(recovered));
}

}  // namespace nda::recovery
