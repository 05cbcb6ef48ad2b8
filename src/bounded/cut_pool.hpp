#pragma once

#include <span>
#include <vector>

#include "bounded/bound.hpp"
#include "bounded/bounded_component.hpp"
#include "bounded/relaxed_program.hpp"
#include "core/random.hpp"
#include "cutting/cut.hpp"

namespace nda::bounded {

/// Cuts of a component: those that the one-to-one problem has (cutting/separation), over the
/// indices that may be used once at most.  What is over other indices is left alone.
class CutPool {
 public:
  /// Cuts hold for all choices of `live` arcs, and have coefficients for these alone.
  CutPool(const BoundedComponent& component, std::span<const core::ArcId> live);

  /// Adds cuts that the point of the linear program violates, the most violated first; returns how
  /// many.  All live arcs must be in the program, which must have the cuts of this pool alone.
  std::size_t separate(RelaxedProgram& program, const core::Deadline& deadline);

  /// What the duals of the cuts charge arcs.
  CutPrices prices(const RelaxedProgram& program) const;

  bool empty() const { return cuts_.empty(); }

 private:
  struct Listed {
    std::vector<cutting::CutEntry> entries;
    int right_side;
  };

  core::Component packing_;  // the graph, with 0 for indices of several uses
  std::vector<core::ArcId> live_;
  cutting::SlotIndex arcs_;
  cutting::CutLister lister_;
  core::Random random_{1};
  std::vector<Listed> cuts_;
};

}  // namespace nda::bounded
